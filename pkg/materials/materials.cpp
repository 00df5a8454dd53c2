#include "materials/materials.hpp"

#include <fmt/core.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "core/errors.hpp"
#include "fracture/brittle_checks.hpp"
#include "mesh/material_constants.hpp"

namespace yadefrag {
namespace {

/// Of the constants of a part that every class has, those of this class.
template <class Part>
Attributes attributesOf(Part FEMat::*part, const Constants<Part>& constants) {
  Attributes all;
  for (const Constant<Part>& one : constants)
    if (*one.doc != 0) all.push_back(attribute(one.name, part, one.member, one.doc));
  return all;
}

Attributes curvesOfCracks() {
  using C = BrittleFEMat;
  return attributeList(
      attribute("softening", &C::softening,
                "How the traction of a crack decreases with its opening w; fractureEnergy Gc is "
                "the area below it, ft the strength, wc the opening without traction. "
                "'linear': to 0 at wc = 2*Gc/ft. 'bilinear' or 'petersson': by ft/3 at "
                "w = 0.8*Gc/ft, wc = 3.6*Gc/ft (Petersson 1981). 'ceb-fip-2010': by ft/5 at "
                "w = Gc/ft, wc = 5*Gc/ft (fib Model Code 2010). 'exponential': "
                "ft*exp(-w*ft/Gc), to 0 at 7*Gc/ft. 'reinhardt': ft*((1 + (3*w/wc)**3)*"
                "exp(-6.93*w/wc) - 28*exp(-6.93)*w/wc), wc = 5.14*Gc/ft (Cornelissen, Hordijk "
                "and Reinhardt 1986, Heron 31, 45). Or a list of points (w/wc, traction/ft) "
                "from (0, 1) to (1, 0). Unloading is towards the origin."),
      attribute(
          "coarseMesh", &C::coarseMesh,
          "What a body gets whose triangles, of size h, do not resolve the cohesive zone l = "
          "g*young*fractureEnergy/tensileStrength**2 (4*h > l; g: that of softening, see the "
          "manual, Fracture); strength and energy cannot both be kept. 'warn': both as given, "
          "with a message; cracks need too much load. 'strength': the strength is reduced to "
          "sqrt(l/(4*h)) of it: cracks run at the right load, and uncracked bodies break too "
          "early. 'energy': the energy is raised to 4*h/l of it: uncracked bodies have the right "
          "strength, and cracked ones carry too much. By triangle, when the body is added; a "
          "message names the values (scaling as in Bazant and Oh 1983, Materials and Structures "
          "16, 155). Without fractureEnergy it has no effect."),
      attribute(
          "rateEffect", &C::rateEffect,
          "By which factor the strength increases with the strain rate at which an edge cracks. "
          "The rate is the mean one since the edge's traction t exceeded the strength ft of slow "
          "tests: (t - ft)/young over that time (plane strain: young/(1 - poisson**2)); the edge "
          "cracks when t reaches ft*factor(rate). 'none': 1. 'ceb-fip-2010', concrete (fib Model "
          "Code 2010, 5.1.11.2): (rate/1e-6)**0.018 up to 10 /s, 0.0062*(rate/1e-6)**(1/3) "
          "above, 1 below 1e-6 /s, constant (4.15) from 300 /s on. Or a list of points (strain "
          "rate in 1/s, factor), rates increasing, factors at least 1; between them log(factor) "
          "is linear in log(rate), outside the factor is that of the nearest point. It "
          "multiplies the strength that an edge has by tensileStrength, strength, jointStrength, "
          "scatter and coarseMesh, and so the cohesion shearFactor*tensileStrength, but not the "
          "friction. An edge between two materials has the effect of the weaker one, bonds have "
          "none. A crack keeps its factor."),
      attribute(
          "speedEffect", &C::speedEffect,
          "By which factor the energy of a crack increases with its speed when it reaches an edge: "
          "the way from the edge from which it came, over the time between the starts of both. "
          "'none': 1. Or a list of points (speed in m/s, factor), speeds increasing, factors at "
          "least 1; between them log(factor) is linear in log(speed), outside the factor is that "
          "of the nearest point. It multiplies the energy that an edge has by fractureEnergy, "
          "jointEnergy, coarseMesh and rateEffect; bonds have none. An edge keeps its energy, "
          "which crackTable lists. Cracks then slow down as in tests (see the manual, Fracture)."));
}

Attributes failureScatter() {
  using C = PlasticFEMat;
  return attributeList(
      attribute("weibullModulus", &C::brittle, &BrittleMaterial::weibullModulus,
                "Modulus m of a Weibull scatter from triangle to triangle of a factor of the "
                "failure strain and of spallStress: a part 1 - exp(-(s/scale)**m) of the "
                "triangles has a smaller factor than s. The scale is 1, or depends on "
                "referenceVolume; 0: none."),
      attribute("strengthScatter", &C::brittle, &BrittleMaterial::strengthScatter,
                "Relative half-width of a uniform scatter of that factor; 0: none."),
      attribute("seed", &C::seed, "Seed of the scatter's random numbers."),
      attribute("referenceVolume", &C::brittle, &BrittleMaterial::referenceVolume,
                "V0 (m³): a triangle with the volume V has the scale (V0/V)**(1/m), so that the "
                "least factor in a body does not depend on its mesh. 0: the scale is 1 for "
                "triangles of any size."));
}

}  // namespace

Attributes FEMat::attributes() {
  return attributeList(
      attribute("planeStress", &FEMat::planeStress,
                "Plane stress (thin plate, free to change its thickness) instead of "
                "plane strain (held at both faces)."));
}

Attributes BrittleFEMat::attributes() {
  return joined(
      {attributesOf(&FEMat::brittle, brittleConstants()),
       attributeList(attribute("seed", &FEMat::seed, "Seed of the scatter's random numbers.")),
       curvesOfCracks()});
}

Attributes PlasticFEMat::attributes() {
  return joined({attributesOf(&FEMat::plastic, metalConstants()),
                 attributeList(attribute(
                     "hardeningTable", &PlasticFEMat::hardeningTable,
                     "'none', or a list of points (plastic strain, yield stress in Pa), which "
                     "replaces the first factor: strains from 0 on, increasing, stresses not "
                     "decreasing; linear between the points, constant after the last one.")),
                 attributesOf(&FEMat::failure, failureConstants()), failureScatter()});
}

Attributes FrictionalFEMat::attributes() {
  using C = FrictionalFEMat;
  return joined(
      {attributesOf(&FEMat::plastic, coneConstants()),
       attributeList(
           attribute("internalFriction", &C::internalFriction,
                     "phi (rad): the shear strength in plane strain is c + tan(phi)*pressure. "
                     "(frictionAngle is that of the surface, in contact.)"),
           attribute("dilationAngle", &C::dilationAngle,
                     "psi (rad), at most phi: plastic flow increases the volume as a cone of this "
                     "angle; 0: it keeps the volume."),
           attribute("failureStrain", &C::failure, &FailureLaw::strain,
                     "Equivalent plastic strain, of any flow, at which a triangle fails; inf: "
                     "none."),
           attribute("fractureEnergy", &C::failure, &FailureLaw::energy,
                     "Energy (J/m²) of a crack. If it is not 0, a triangle fails also where its "
                     "mean stress would exceed the largest one, tensionLimit: its edges open as "
                     "those of a BrittleFEMat, with the traction that acts then as their strength, "
                     "which falls to 0 linearly. 0: tension flows there, and after failureStrain "
                     "cracks open at once."))});
}

namespace {

void requireAngle(const char* name, double angle) {
  if (!(angle >= 0 && angle < std::numbers::pi / 2))
    throw InputError(wrongValue(name, angle, "", "at least 0 and below π/2 (rad)"));
}

/// From angles to their tangents.
void completeCone(const FrictionalFEMat& material, PlasticMaterial& cone) {
  requireAngle("internalFriction", material.internalFriction);
  if (!(material.dilationAngle >= 0 && material.dilationAngle <= material.internalFriction))
    throw InputError(
        fmt::format("dilationAngle is {:g}; it must be at least 0 and at most internalFriction.",
                    material.dilationAngle));
  cone.internalFriction = std::tan(material.internalFriction);
  cone.dilation = std::tan(material.dilationAngle);
  if (cone.failure.energy > 0) cone.failure.spallStress = Cone(cone).limit;
  if (cone.cohesion == 0 && material.internalFriction == 0)
    throw InputError("cohesion and internalFriction are 0; one of them must be positive.");
}

}  // namespace

BodyMaterial bodyMaterialOf(const FEMat& material) {
  requireAngle("frictionAngle", material.frictionAngle);
  BodyMaterial one = {
      .material = {material.young, material.poisson, material.density, material.planeStress},
      .brittle = material.brittle,
      .friction = std::tan(material.frictionAngle),
      .plastic = material.plastic};
  one.brittle.seed = static_cast<std::uint64_t>(material.seed);
  one.plastic.failure = material.failure;
  if (const auto* brittle = dynamic_cast<const BrittleFEMat*>(&material)) {
    one.brittle.softening = brittle->softening.law();
    one.brittle.rate = brittle->rateEffect.law();
    one.brittle.speed = brittle->speedEffect.law();
    checkBrittle(one.brittle);
    return one;
  }
  if (const auto* plastic = dynamic_cast<const PlasticFEMat*>(&material))
    one.plastic.table = plastic->hardeningTable.law();
  else if (const auto* frictional = dynamic_cast<const FrictionalFEMat*>(&material))
    completeCone(*frictional, one.plastic);
  else
    return one;
  if (const std::string wrong = one.plastic.wrong(); !wrong.empty()) throw InputError(wrong);
  return one;
}

namespace {

using Values = std::vector<std::pair<const char*, double>>;

void add(Values& all, const FEMat& material, const Attributes& attributes) {
  for (const Attribute& one : attributes)
    if (one.kind->number != nullptr)
      all.emplace_back(one.name, one.kind->number(one.slot(material)));
}

Values valuesOf(const FEMat& material) {
  Values all = {{"young", material.young},
                {"poisson", material.poisson},
                {"density", material.density},
                {"frictionAngle", material.frictionAngle}};
  add(all, material, FEMat::attributes());
  const auto addIf = [&]<class Kind>(const Kind* /*kind*/) {
    if (dynamic_cast<const Kind*>(&material) != nullptr) add(all, material, Kind::attributes());
  };
  addIf(static_cast<const BrittleFEMat*>(nullptr));
  addIf(static_cast<const PlasticFEMat*>(nullptr));
  addIf(static_cast<const FrictionalFEMat*>(nullptr));
  return all;
}

std::vector<double> numbersOf(const FEMat& material) {
  std::vector<double> numbers;
  for (const auto& [name, value] : valuesOf(material)) numbers.push_back(value);
  return numbers;
}

}  // namespace

void MaterialWatch::add(const yade::shared_ptr<FEMat>& material) {
  std::vector<double> values = numbersOf(*material);
  for (const Used& used : used_)
    if (used.material == material && used.values == values) return;
  used_.push_back({material, std::move(values)});
}

std::vector<std::string> MaterialWatch::sentences() const {
  std::vector<std::string> found;
  for (const Used& used : used_) {
    const Values now = valuesOf(*used.material);
    const std::string label = used.material->label.empty()
                                  ? fmt::format("number {}", used.material->id)
                                  : fmt::format("'{}'", used.material->label);
    for (std::size_t i = 0; i < now.size(); ++i)
      if (now[i].second != used.values[i])
        found.push_back(fmt::format(
            "{} of material {} was changed from {:g} to {:g} after bodies had been made of it: "
            "they keep {:g}; set it before addPolygon, or remove these bodies and add them again.",
            now[i].first, label, used.values[i], now[i].second, used.values[i]));
  }
  return found;
}

}  // namespace yadefrag
