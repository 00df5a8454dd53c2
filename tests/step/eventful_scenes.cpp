#include "step/eventful_scenes.hpp"

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>

#include <sstream>

#include "elements/blocks.hpp"
#include "solver/column_archive.hpp"
#include "step/bodies.hpp"
#include "yade/any_archive.hpp"

namespace yadefrag::test {
namespace {

TriangleMesh rectangleAt(Vec2 low, Vec2 size, int nx, int ny) {
  return structuredRectangle(low, low + size, nx, ny, QuadPattern::kCrossed);
}

/// A row of blocks; the outer ones fly inwards. `change` is called for each body.
World row(int count, double gap, double speed,
          const std::function<void(int, BodySpec&, const TriangleMesh&)>& change) {
  World world = twoPasses();
  for (int k = 0; k < count; ++k) {
    const TriangleMesh mesh = rectangleAt({(1 + gap) * k, .07 * k}, {1, 1}, 3 + k % 3, 4);
    const double inwards = k == 0 ? speed : k == count - 1 ? -speed : 0;
    BodySpec spec = moving(mesh, rubber(), {inwards, .1 * inwards});
    spec.friction = .3;
    change(k, spec, mesh);
    world.addBody(mesh, spec);
  }
  return world;
}

void nothing(int, BodySpec&, const TriangleMesh&) {}

/// A body for each law of flow, the first ones of several chunks of triangles; all bulge and shear.
World flowing(int parity) {
  World world = twoPasses();
  const std::vector<PlasticMaterial> laws = plasticLaws();
  for (int k = 0; k < static_cast<int>(laws.size()); ++k) {
    const Vec2 low{1.002 * k, 0};
    const TriangleMesh mesh = rectangleAt(low, {1, 1}, k < 2 ? 12 : 3, k < 2 ? 12 : 4);
    BodySpec spec = moving(mesh, steel(), {});
    spec.plastic = laws[static_cast<std::size_t>(k)];
    spec.element = k % 2 == parity ? ElementKind::kSmoothed : ElementKind::kLinear;
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
      const Vec2 x = mesh.nodes[n] - low - Vec2{.5, .5};
      spec.velocity[n] = 120 * Vec2{x.x + x.y / 2, std::sin(3 * x.x) * x.y};
    }
    world.addBody(mesh, spec);
  }
  return world;
}

void shatter(BodySpec& spec, double fractureEnergy) {
  spec.brittle.tensileStrength = 2e5;
  spec.brittle.strengthScatter = .3;
  spec.brittle.fractureEnergy = fractureEnergy;
}

}  // namespace

State stateOf(World& world) {
  State state;
  const auto add = [&](const char* name, const auto& value) {
    state[name].append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  for (const ContactRow& row : world.contact.rows()) {
    add("rows", row.slave), add("rows", row.master), add("normals", row.normal);
    add("gaps", row.gap), add("gaps", row.toleratedGap);
    add("slips", row.slip), add("slips", row.friction);
    add("rows' forces", row.normalForce), add("rows' forces", row.tangentForce);
  }
  for (std::size_t n = 0; n < world.model.nodes.size(); ++n)
    add("contact forces", world.contact.forces()[n]);
  add("figures", world.contact.largestCorrection());
  add("figures", world.contact.maxPenetration());
  for (const Vec2 force : world.loads.outerForces) add("outer forces", force);
  for (const Vec2 position : world.model.nodes.position) add("position", position);
  for (const Vec2 velocity : world.model.nodes.velocity) add("velocity", velocity);
  for (const EntryId master : world.contact.candidates.masters) add("masters", master);
  for (const NodeId node : world.search.nodes) add("search", node);
  add("search", world.search.halo), add("search", world.search.validity);
  add("search", world.numSearches());
  add("ledger", world.ledger);
  for (const auto& opening : world.fracture.cohesion.largest) add("openings", opening);
  for (const auto& traction : world.fracture.cohesion.traction) add("tractions", traction);
  state["saved"] = saved(world);
  return state;
}

std::string whatDiffers(const State& a, const State& b) {
  std::string names;
  for (const auto& [name, bytes] : a)
    if (!b.contains(name) || b.at(name) != bytes) names += name + "; ";
  return names;
}

std::map<std::string, Scene> scenes() {
  std::map<std::string, Scene> all;
  all["contact"] = [] { return row(3, .002, 6, nothing); };
  all["smooth"] = [] {
    return row(3, .002, 6,
               [](int, BodySpec& spec, const TriangleMesh& mesh) { smoothAll(spec, mesh); });
  };
  all["apart"] = [] {
    return row(4, .05, 12,
               [](int, BodySpec& spec, const TriangleMesh&) { spec.selfContact = false; });
  };
  all["rubble"] = [] {
    return row(3, .002, 14, [](int k, BodySpec& spec, const TriangleMesh&) {
      if (k < 2) shatter(spec, 0);
    });
  };
  all["cohesion"] = [] {
    return row(3, .002, 14, [](int, BodySpec& spec, const TriangleMesh&) { shatter(spec, 2000); });
  };
  all["smoothed"] = [] {
    return row(3, .002, 14, [](int k, BodySpec& spec, const TriangleMesh&) {
      shatter(spec, k == 1 ? 2000 : 0);
      spec.element = ElementKind::kSmoothed;
    });
  };
  all["dropped"] = [] {
    World world =
        row(3, .002, 14, [](int, BodySpec& spec, const TriangleMesh&) { shatter(spec, 0); });
    world.fracture.minFragmentArea = .1;
    return world;
  };
  all["torn"] = [] {
    return row(3, .002, 14, [](int k, BodySpec& spec, const TriangleMesh&) {
      spec.plastic.yieldStress = 1e5, spec.plastic.hardening = 1e5;
      spec.plastic.failure.strain = .02 + .01 * k;
      spec.plastic.failure.energy = 2000;
      if (k == 0) spec.brittle.strengthScatter = .3;
      spec.element = k == 1 ? ElementKind::kLinear : ElementKind::kSmoothed;
    });
  };
  all["crushed"] = [] {
    return row(3, .002, 14, [](int k, BodySpec& spec, const TriangleMesh&) {
      PlasticMaterial& m = spec.plastic;
      m.cohesion = 3e5, m.internalFriction = m.dilation = .3;
      m.tensionLimit = m.failure.spallStress = 1e5;
      m.failure.energy = 2000;
      spec.element = k == 1 ? ElementKind::kLinear : ElementKind::kSmoothed;
    });
  };
  all["driven"] = [] {
    World world = row(2, .002, 6, [](int, BodySpec& spec, const TriangleMesh& mesh) {
      hold(spec, mesh, kHeldY, [](Vec2 x) { return x.y < .01; });
      hold(spec, mesh, kHeldXY, [](Vec2 x) { return x.x < .01; });
    });
    world.dynamicsSettings.damping = 3;
    world.dynamicsSettings.gravity = {0, -9.81};
    world.dynamicsSettings.viscosity = {.06, 1.2};
    world.setLoads(std::vector<Vec2>(world.model.nodes.size(), {10, 20}));
    drive(world, -1, 1e3);
    return world;
  };
  // Bodies of several chunks of triangles.
  all["large"] = [] {
    World world = twoPasses();
    world.dynamicsSettings = {.damping = 3, .gravity = {0, -9.81}, .viscosity = {.06, 1.2}};
    for (const int k : {0, 1}) {
      const TriangleMesh mesh = rectangleAt({1.001 * k, .1 * k}, {1, 1}, 12 + k, 12);
      BodySpec spec = moving(mesh, rubber(), {3. - 6 * k, .5 * k});
      spec.element = k == 0 ? ElementKind::kSmoothed : ElementKind::kLinear;
      world.addBody(mesh, spec);
    }
    return world;
  };
  all["flowing"] = [] { return flowing(0); };
  all["flowingToo"] = [] { return flowing(1); };
  // Open joints cut the bodies across before the first step.
  all["jointed"] = [] {
    return row(3, .002, 14, [](int k, BodySpec& spec, const TriangleMesh& mesh) {
      shatter(spec, 2000);
      const double middle = .07 * k + .5;
      spec.places.joints =
          jointsWhere(mesh, 0, NAN, [&](Vec2 x) { return std::abs(x.y - middle) < 1e-9; });
    });
  };
  // Squares and smooth discs of different meshes that close in on one another.
  all["crowd"] = [] {
    World world;
    for (int k = 0; k < 9; ++k) {
      const int row = k / 3;
      const Vec2 place{double(k % 3), double(row)};
      const bool disc = k % 2 == 0;
      const TriangleMesh mesh =
          triangulate({circle(1.02 * place, .5, disc ? 16 : 4, .7 * k), {}}, 1. / (4 + k % 3));
      BodySpec spec = moving(mesh, rubber(), 6 * (Vec2{1, 1} - place) + Vec2{.1 * k, 0});
      spec.friction = .3;
      if (disc) smoothAll(spec, mesh);
      world.addBody(mesh, spec);
    }
    return world;
  };
  all["alone"] = [] {
    return row(1, 0, 6, [](int, BodySpec& spec, const TriangleMesh&) { spec.selfContact = false; });
  };
  all["places"] = [] {
    return row(3, .002, 14, [](int k, BodySpec& spec, const TriangleMesh& mesh) {
      shatter(spec, 2000);
      spec.brittle.shearEnergyFactor = 3;
      if (k > 0) spec.brittle.softening = softeningNamed("petersson");
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const double part = 1 + .5 * static_cast<double>(t % 3);
        spec.places.strength.push_back(part * 2e5);
        spec.places.fractureEnergy.push_back(part * 2000);
      }
    });
  };
  all["mixed"] = [] {
    return row(3, .002, 14, [](int, BodySpec& spec, const TriangleMesh& mesh) {
      BodyMaterial strong = spec, weak = spec;
      strong.material.young *= 3, strong.brittle.tensileStrength = 6e5;
      weak.brittle.tensileStrength = 2e5, weak.brittle.fractureEnergy = 2000;
      spec.materials.materials = {strong, weak};
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        spec.materials.ofTriangle.push_back(mesh.nodes[mesh.triangles[t][0]].y < .5 ? 0 : 1);
    });
  };
  all["rate"] = [] {
    return row(3, .002, 14, [](int k, BodySpec& spec, const TriangleMesh&) {
      shatter(spec, k == 1 ? 2000 : 0);
      spec.brittle.rate = rateEffectNamed("ceb-fip-2010");
      spec.brittle.speed = RateEffect({{100, 1}, {1000, 2}}, kCrackSpeed);
    });
  };
  all["stressed"] = [] {
    return row(3, .002, 6, [](int k, BodySpec& spec, const TriangleMesh& mesh) {
      spec.stress.assign(mesh.triangles.size(), {1e5, -2e5, 5e4});
      if (k > 0) spec.stressAcross.assign(mesh.triangles.size(), -1e5);
      if (k > 1) spec.plastic.yieldStress = 1e6;
    });
  };
  // A cylinder flies to a ring that is stressed, too.
  all["axis"] = [] {
    World world = twoPasses();
    world.setAxisymmetric(true);
    for (const int k : {0, 1}) {
      const TriangleMesh mesh = rectangleAt({.3 * k, 1.002 * k}, {1, 1}, 4 + k, 4);
      BodySpec spec = moving(mesh, rubber(), {0, 6. - 12 * k});
      spec.stress.assign(mesh.triangles.size(), {1e5, -2e5, 0});
      spec.stressAcross.assign(mesh.triangles.size(), 5e4);
      world.addBody(mesh, spec);
    }
    return world;
  };
  // Sides with different ends are divided before they are bonded.
  all["bonded"] = [] {
    World world = row(4, 0, -2, nothing);
    world.bondAll(1e-6, 2e5, 200);
    return world;
  };
  all["rigid"] = [] {
    World world = row(2, .002, 6, nothing);
    world.addRigid(rigidLine({5, -.1}, {-5, -.3}, .3));
    world.dynamicsSettings.gravity = {0, -300};
    return world;
  };
  return all;
}

World copyOf(World& world) {
  World copy;
  copy.contactSettings = world.contactSettings;
  copy.dynamicsSettings = world.dynamicsSettings;
  copy.fracture.minFragmentArea = world.fracture.minFragmentArea;
  load(saved(world), copy);
  return copy;
}

void drive(World& world, double speed, double pressure) {
  const std::vector<NodeId> driven{NodeId(world.model.nodes.size() - 1)};
  world.prescribeMotion(
      driven, kHeldXY,
      {.centre = {.02, 0}, .speedX = TimeTable({0, 1e-5}, {0, speed}), .turn = TimeTable(3)});
  const std::vector<NodeId>& rim = world.surfaces.segmentNode;
  world.setPressure(std::span(rim).first(3), TimeTable({0, 1}, {pressure, 2 * pressure}));
  world.setAbsorbing(std::span(rim).last(3));
}

World eventfulWorld(bool isDriven) {
  World world = twoPasses();
  for (int k = 0; k < 3; ++k) {
    const Vec2 low{.01 * k, 0};
    const TriangleMesh mesh =
        structuredRectangle(low, low + Vec2{.01, .01}, 3 + k, 3, QuadPattern::kCrossed);
    BodySpec spec = moving(mesh, {1e9, .2, 1000, false}, {30. - 30 * k, 0});
    spec.friction = .3;
    if (k < 2) spec.brittle.tensileStrength = 1e6;
    if (k == 1) spec.brittle.fractureEnergy = 20;
    if (k == 2) smoothAll(spec, mesh);
    world.addBody(mesh, spec);
  }
  if (isDriven) drive(world);
  world.setLoads(std::vector<Vec2>(world.model.nodes.size(), {1, 2}));
  const double dt = .3 * world.criticalTimeStep();
  while (world.steps < 30) world.step(dt);
  return world;
}

std::string saved(World& world, unsigned flags) {
  std::ostringstream text;
  boost::archive::binary_oarchive archive(text, flags | boost::archive::no_codecvt);
  std::vector<int> bodies(world.surfaces.entries());
  ArchiveOf any(archive);
  std::vector<Vec2> forces;
  archiveWorld(any, world, bodies, forces);
  return text.str();
}

void load(const std::string& bytes, World& world, unsigned flags) {
  std::istringstream text(bytes);
  boost::archive::binary_iarchive archive(text, flags | boost::archive::no_codecvt);
  std::vector<int> bodies;
  ArchiveOf any(archive);
  std::vector<Vec2> forces;
  archiveWorld(any, world, bodies, forces);
}

}  // namespace yadefrag::test
