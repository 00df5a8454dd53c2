#include "fe/materials.hpp"

#include <fmt/core.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "core/errors.hpp"
#include "core/wrong_value.hpp"
#include "fracture/brittle_checks.hpp"

namespace yadefrag {
namespace {

Attributes crackAttributes() {
  using C = BrittleFEMat;
  return attributeList(
      attribute("tensileStrength", &C::brittle, &BrittleMaterial::tensileStrength,
                "Tensile strength ft (Pa). An edge between two triangles cracks where its normal "
                "stress sigma (positive: tension) and its shear stress tau reach "
                "sqrt(sigma**2 + (tau/beta)**2) = ft under tension, or "
                "|tau| = beta*ft + tan(phi)*|sigma| under pressure (Camacho and Ortiz 1996, Int. "
                "J. Solids Struct. 33, 2899); beta is shearFactor, phi frictionAngle. So the "
                "cohesion of Mohr and Coulomb is c = beta*ft."),
      attribute("fractureEnergy", &C::brittle, &BrittleMaterial::fractureEnergy,
                "Energy (J/m²) that opens a crack in tension; 0: it opens at once."),
      attribute("shearFactor", &C::brittle, &BrittleMaterial::shearFactor,
                "beta: shear strength over tensile strength. The shear strength is "
                "beta*tensileStrength + tan(frictionAngle)*pressure: a larger beta makes it "
                "harder to crack in shear."),
      attribute(
          "shearEnergyFactor", &C::brittle, &BrittleMaterial::shearEnergyFactor,
          "kappa: energy per area that a crack dissipates in pure shear, relative to "
          "fractureEnergy, that in pure tension (Snozzi and Molinari 2013, Int. J. Numer. Meth. "
          "Eng. 93, 510). Friction between the faces dissipates additional energy. Without "
          "fractureEnergy it has no effect."));
}

Attributes crackScatter() {
  using C = BrittleFEMat;
  return attributeList(
      attribute("weibullModulus", &C::brittle, &BrittleMaterial::weibullModulus,
                "Modulus m of a Weibull scatter of the strength (Weibull 1951, J. Appl. Mech. 18, "
                "293): a part 1 - exp(-(s/scale)**m) of the edges is weaker than s. The scale is "
                "tensileStrength, or depends on referenceVolume; 0: none."),
      attribute("strengthScatter", &C::brittle, &BrittleMaterial::strengthScatter,
                "Relative half-width of a uniform scatter of the strength; 0: none."),
      attribute("seed", &C::seed, "Seed of the scatter's random numbers."),
      attribute("referenceVolume", &C::brittle, &BrittleMaterial::referenceVolume,
                "V0 (m³) for which tensileStrength is the scale of the Weibull scatter: an edge "
                "with a volume V has the scale tensileStrength*(V0/V)**(1/m), so that "
                "a finer mesh is not weaker. V is thickness times a third of the areas of the "
                "edge's two triangles, so all edges together have the body's volume. 0: the "
                "scale is tensileStrength for edges of any size, and the more edges, the weaker "
                "the weakest. Without weibullModulus it has no effect."));
}

Attributes crackLaw() {
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
          "rateEnergyPower", &C::brittle, &BrittleMaterial::rateEnergyPower,
          "p: where rateEffect multiplies the strength of an edge by a factor, its "
          "fractureEnergy is multiplied by factor**p (as repow of LS-DYNA's MAT_CSCM, Murray "
          "2007, FHWA-HRT-05-062). 1: the critical opening stays the same; 0: the energy does; "
          "2: the length of the cohesive zone does."));
}

Attributes hardeningAttributes() {
  using C = PlasticFEMat;
  return attributeList(
      attribute("yieldStress", &C::plastic, &PlasticMaterial::yieldStress,
                "A (Pa): yield stress before any plastic strain, in slow deformation at "
                "startTemperature."),
      attribute("hardening", &C::plastic, &PlasticMaterial::hardening, "B (Pa); 0: no hardening."),
      attribute("hardeningExponent", &C::plastic, &PlasticMaterial::hardeningExponent,
                "n, above 0 and at most 1; 1: linear hardening."),
      attribute("offsetStrain", &C::plastic, &PlasticMaterial::offsetStrain,
                "p0: if it is not 0, the first factor is the power law A*(1 + p/p0)**n instead "
                "of A + B*p**n."),
      attribute("hardeningTable", &C::hardeningTable,
                "'none', or a list of points (plastic strain, yield stress in Pa), which "
                "replaces the first factor: strains from 0 on, increasing, stresses not "
                "decreasing; linear between the points, constant after the last one."));
}

Attributes rateAndHeat() {
  using C = PlasticFEMat;
  return attributeList(
      attribute("rateFactor", &C::plastic, &PlasticMaterial::rateFactor,
                "C; 0: the rate has no effect."),
      attribute("referenceRate", &C::plastic, &PlasticMaterial::referenceRate,
                "Plastic strain rate (1/s) up to which the second factor is 1."),
      attribute("thermalExponent", &C::plastic, &PlasticMaterial::thermalExponent,
                "m; 0: the temperature has no effect on the yield stress."),
      attribute("meltTemperature", &C::plastic, &PlasticMaterial::meltTemperature,
                "Temperature (K) at which the yield stress is 0; without thermalExponent it has "
                "no effect."),
      attribute("startTemperature", &C::plastic, &PlasticMaterial::startTemperature,
                "Temperature (K) of the body when it is added."),
      attribute("heatCapacity", &C::plastic, &PlasticMaterial::heatCapacity,
                "Specific heat (J/(kg K)); the plastic work heats each triangle, without "
                "conduction. 0: the temperature stays the same."),
      attribute("heatShare", &C::plastic, &PlasticMaterial::heatShare,
                "Part of the plastic work that becomes heat (Taylor and Quinney)."));
}

Attributes failureAttributes() {
  using C = PlasticFEMat;
  return attributeList(
      attribute("failureStrain", &C::failure, &FailureLaw::strain,
                "Equivalent plastic strain at which a triangle fails; with failureD1 or "
                "failureD2 the least failure strain of their formula. inf: none."),
      attribute("failureD1", &C::failure, &FailureLaw::d, 0,
                "D1 of Johnson and Cook's failure strain (1985, Eng. Fract. Mech. 21, 31): "
                "(D1 + D2*exp(D3*s)) * (1 + D4*ln(rate/referenceRate)) * (1 + D5*T), with the "
                "mean stress over von Mises' stress s (tension positive, at most 1.5), the rate "
                "of the plastic strain (the factor is that of at least referenceRate) and T of "
                "the yield stress. The sum of plastic strain increments over it is the damage; "
                "at 1 the triangle fails: its edges open as those of a BrittleFEMat, with the "
                "traction that acts then as their strength, and with fractureEnergy. "
                "failureD1 = failureD2 = 0: none."),
      attribute("failureD2", &C::failure, &FailureLaw::d, 1, "D2, 0 or positive."),
      attribute("failureD3", &C::failure, &FailureLaw::d, 2,
                "D3, 0 or negative; papers that count pressure as positive give -D3."),
      attribute("failureD4", &C::failure, &FailureLaw::d, 3, "D4; 0: the rate has no effect."),
      attribute("failureD5", &C::failure, &FailureLaw::d, 4,
                "D5; 0: the temperature has no effect; otherwise with meltTemperature."),
      attribute("spallStress", &C::failure, &FailureLaw::spallStress,
                "Tensile mean stress (Pa) at which a triangle fails at once; inf: none."),
      attribute("fractureEnergy", &C::failure, &FailureLaw::energy,
                "Energy (J/m²) that opens a crack where the material has failed, from the "
                "traction that acts to 0, linearly; 0: it opens at once. The plastic work until "
                "then is not part of it."));
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
  return joined({crackAttributes(), crackScatter(), crackLaw()});
}

Attributes PlasticFEMat::attributes() {
  return joined({hardeningAttributes(), rateAndHeat(), failureAttributes(), failureScatter()});
}

Attributes FrictionalFEMat::attributes() {
  using C = FrictionalFEMat;
  return attributeList(
      attribute("cohesion", &C::plastic, &PlasticMaterial::cohesion,
                "c (Pa); 0: dry sand, with internalFriction."),
      attribute("internalFriction", &C::internalFriction,
                "phi (rad): the shear strength in plane strain is c + tan(phi)*pressure. "
                "(frictionAngle is that of the surface, in contact.)"),
      attribute("dilationAngle", &C::dilationAngle,
                "psi (rad), at most phi: plastic flow increases the volume as a cone of this "
                "angle; 0: it keeps the volume."),
      attribute("tensionLimit", &C::plastic, &PlasticMaterial::tensionLimit,
                "Largest tensile mean stress (Pa); inf: that of the cone's apex, c/tan(phi)."),
      attribute("failureStrain", &C::failure, &FailureLaw::strain,
                "Equivalent plastic strain, of any flow, at which a triangle fails; inf: none."),
      attribute("fractureEnergy", &C::failure, &FailureLaw::energy,
                "Energy (J/m²) of a crack. If it is not 0, a triangle fails also where its mean "
                "stress would exceed the largest one, tensionLimit: its edges open as those of a "
                "BrittleFEMat, with the traction that acts then as their strength, which falls "
                "to 0 linearly. 0: tension flows there, and after failureStrain cracks open at "
                "once."));
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
