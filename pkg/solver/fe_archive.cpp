#include "solver/column_archive.hpp"

#include <boost/archive/archive_exception.hpp>

#include <algorithm>
#include <string>

#include "core/errors.hpp"
#include "mesh/material_constants.hpp"
#include "step/world.hpp"

namespace yadefrag {
namespace {

/// With the checksum a fuzzer would never reach the code behind it.
constexpr bool kIgnoreChecksum =
#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
    true;
#else
    false;
#endif

class WorldArchive : ColumnArchive {
 public:
  using ColumnArchive::ColumnArchive;

  void run(World& world, std::vector<int>& entryBodies, std::vector<Vec2>& forces) {
    try {
      all(world, entryBodies, forces);
    } catch (const boost::archive::archive_exception& error) {
      if (!isLoading())
        throw RunError(
            "FESolver could not be saved (" + std::string(error.what()) +
            "): its file cannot be opened or the disk is full, and the file is incomplete.");
      refuse(error.what());
    }
  }

 private:
  static constexpr std::uint64_t kFormat = 24;

  void all(World& world, std::vector<int>& entryBodies, std::vector<Vec2>& forces) {
    std::uint64_t format = kFormat;
    value("format", format);
    if (format != kFormat) refuse("its format is " + std::to_string(format));
    state(world);
    std::vector<Vec2> reactions = world.reactions;
    column("reactions", reactions), column("contactForces", forces);
    value("entryBodies", entryBodies);
    const bool isRight = checksum();
    if (isLoading()) {
      if (!isRight && !kIgnoreChecksum) refuse("its checksum is wrong");
      const std::string wrong = findInvalidPart(world);
      if (!wrong.empty()) refuse(wrong + " are invalid");
      if (entryBodies.size() != world.surfaces.entries()) refuse("its bodies are invalid");
      if (std::max(reactions.size(), forces.size()) > world.model.nodes.size())
        refuse("its forces are invalid");
      world.rebuild();
      world.reactions = std::move(reactions);
    }
  }

  void state(World& world) {
    value("axisymmetric", world.model.axisymmetric);
    table(world.model.nodes.columns());
    motions(world.model.motions);
    table(world.model.triangles.columns());
    components(world.model.components);
    materials(world.model.materials);
    surfaces(world.surfaces);
    loads(world);
    contact(world.contact);
    search(world);
    fracture(world.fracture);
    EnergyLedger& ledger = world.ledger;
    value("contactEnergy", ledger.contact), value("frictionEnergy", ledger.friction);
    value("fractureWork", ledger.fracture), value("dampingEnergy", ledger.damping);
    value("externalEnergy", ledger.external), value("droppedEnergy", ledger.dropped);
    value("createdSpin", ledger.spin), value("plasticEnergy", ledger.plastic);
    Dropped& dropped = world.dropped;
    value("droppedMass", dropped.mass), value("dropped", dropped.count);
    value("droppedMomentumX", dropped.momentum.x), value("droppedMomentumY", dropped.momentum.y);
    watch(world);
    value("steps", world.steps), value("time", world.time), value("lastDt", world.lastDt);
    value("stableStep", world.stableStep);
    PlasticFlow::Steepness steepness = world.steepness();
    value("steepness", steepness.known), value("lastSteepness", steepness.last);
    if (isLoading()) world.loadedSteepness = steepness;
    value("stableLinearViscosity", world.stableViscosity.linear);
    value("stableQuadraticViscosity", world.stableViscosity.quadratic);
    value("numSearches", world.search.count);
  }

  void watch(World& world) {
    EnergyWatch& watch = world.watch;
    value("expectedEnergy", watch.expected), value("goneEnergy", watch.gone);
    value("mostEnergy", watch.most), value("watchedContact", watch.dissipated);
    value("mostContact", watch.contact), value("mostFriction", watch.friction);
    value("watchedSplit", watch.split);
    value("lookedCreated", watch.evaluatedCreated), value("lookedGrown", watch.evaluatedGrown);
    value("toldCreated", watch.reportedCreated), value("toldGrown", watch.reportedGrown);
    value("toldDepth", watch.reportedDepth), value("lastStep", watch.lastStep);
    value("leastStep", watch.leastStep), value("mostStep", watch.mostStep);
    value("stepChanges", watch.changes);
    value("mostSpin", watch.mostSpin), value("toldSpin", watch.reportedSpin);
    value("knownGrowth", watch.knownGrowth), value("ofChanges", watch.ofChanges);
    lines("complaints", world.warnings);
  }

  void motions(std::vector<Motion>& motions) {
    FlatMotions flat = flatten(motions);
    value("motionCounts", flat.counts), value("motionNumbers", flat.numbers);
    if (isLoading() && !unflatten(flat, motions)) refuse("its motions are invalid");
  }

  void components(std::vector<Component>& rows) {
    using C = Component;
    materials(rows);
    member("thickness", rows, &C::thickness);
    member("firstTriangle", rows, &C::firstTriangle),
        member("lastTriangle", rows, &C::lastTriangle);
    member("firstMaterial", rows, &C::firstMaterial),
        member("lastMaterial", rows, &C::lastMaterial);
    member("brittleByPlace", rows, &C::brittleByPlace);
    member("selfContact", rows, &C::selfContact), member("rigid", rows, &C::rigid);
    member("element", rows, [](C& c) -> std::uint8_t& {
      return reinterpret_cast<std::uint8_t&>(c.element);  // NOLINT: an unsigned char may name it
    });
    std::vector<std::string> names;
    names.reserve(rows.size());
    for (const C& c : rows) names.push_back(c.name);
    lines("names", names);
    if (names.size() != rows.size()) refuse("names has a wrong length");
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i].name = names[i];
  }

  /// Of bodies, or of a list.
  template <class C>
  void materials(std::vector<C>& rows) {
    const auto constants = [&](const auto& all, auto part) {
      for (const auto& one : all)
        member(one.name, rows, [&](C& c) -> double& { return part(c).*one.member; });
    };
    constants(elasticConstants(), [](C& c) -> ElasticMaterial& { return c.material; });
    member("planeStress", rows, [](C& c) -> bool& { return c.material.planeStress; });
    member("friction", rows, &C::friction);
    constants(brittleConstants(), [](C& c) -> BrittleMaterial& { return c.brittle; });
    member("seed", rows, [](C& c) -> std::uint64_t& { return c.brittle.seed; });
    curves("softeningCounts", "softeningPoints", rows,
           [](C& c) -> SofteningCurve& { return c.brittle.softening; });
    curves("rateCounts", "ratePoints", rows, [](C& c) -> RateEffect& { return c.brittle.rate; });
    curves("speedCounts", "speedPoints", rows, [](C& c) -> RateEffect& { return c.brittle.speed; });
    const auto plastic = [](C& c) -> PlasticMaterial& { return c.plastic; };
    constants(metalConstants(), plastic), constants(coneConstants(), plastic);
    constants(failureConstants(), [](C& c) -> FailureLaw& { return c.plastic.failure; });
    curves("hardeningCounts", "hardeningPoints", rows,
           [](C& c) -> std::vector<HardeningPoint>& { return c.plastic.table; });
  }

  void surfaces(ContactSurfaces& s) {
    table(s.segmentColumns());
    column("nodeSegment", s.nodeSegment);
    table(s.entryColumns());
  }

  void loads(World& world) {
    std::uint64_t count = world.loads.pressures.size();
    value("pressures", count);
    if (count > world.surfaces.segments()) refuse("its pressures are invalid");
    world.loads.pressures.resize(count);
    for (Pressure& one : world.loads.pressures) {
      column("pressureSegments", one.segments);
      value("pressureFunction", one.function), value("pressureFirstNew", one.firstNew);
      table("pressure", one.value);
    }
    column("absorbing", world.loads.absorbing.segments);
  }

  void contact(Contact& contact) {
    using Index = std::uint32_t;
    Candidates& candidates = contact.candidates;
    column("slaves", candidates.slaves), column("offsets", candidates.offsets);
    column("masters", candidates.masters);
    auto& rows = contact.touches;
    member("touchSlave", rows, [](StoredContact& t) -> Index& { return t.pair.slave.value; });
    member("touchMaster", rows, [](StoredContact& t) -> Index& { return t.pair.master.value; });
    member("touchNormal", rows, &StoredContact::normalForce);
    member("touchTangent", rows, &StoredContact::tangentForce);
    member("touchAllowed", rows, &StoredContact::toleratedGap);
  }

  void search(World& world) {
    SearchState& search = world.search;
    value("halo", search.halo), value("shortest", search.shortest);
    bool isDue = search.isDue(), isVoid = search.isVoid();
    value("isDue", isDue), value("isVoid", isVoid);
    if (isLoading()) {
      using enum SearchState::Validity;
      search.validity = isVoid ? kVoid : isDue ? kDue : kValid;
    }
    column("searchNodes", search.nodes), column("searchPositions", search.positions);
    SearchBounds bounds = world.searchBounds();
    value("searchFarthest", bounds.farthest), value("searchSpeed", bounds.speed);
    if (isLoading()) search.loaded = bounds;
  }

  void fracture(Fracture& fracture) {
    using Index = std::uint32_t;
    CrackEdges& edges = fracture.edges;
    table(edges.columns());
    value("crackStart", fracture.started);
    auto& overloads = fracture.overloads;
    member("overloadEdge", overloads, [](Overload& o) -> Index& { return o.edge.value; });
    member("overloadSince", overloads, &Overload::since);
    column("elementEdges", edges.ofElement), column("nodeElement", edges.ofNode);
    table(fracture.cohesion.columns());
    std::uint64_t numCracks = fracture.numCracks();
    value("numCracks", numCracks);
    fracture.restore(numCracks);
  }
};

}  // namespace

void archiveWorld(AnyArchive& archive, World& world, std::vector<int>& entryBodies,
                  std::vector<Vec2>& forces) {
  WorldArchive(archive).run(world, entryBodies, forces);
}

}  // namespace yadefrag
