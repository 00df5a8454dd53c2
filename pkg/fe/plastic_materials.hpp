#pragma once
// Materials of finite-element bodies that yield.

#include <cmath>
#include <limits>
#include <tuple>

#include "fe/materials.hpp"

namespace yadefrag {

class PlasticFEMat : public Published<PlasticFEMat, Indexed<PlasticFEMat, FEMat>, FEMat> {
 public:
  static constexpr const char* kName = "PlasticFEMat";
  static constexpr const char* kDoc =
      "An FEMat that yields (J2 plasticity, isotropic hardening). The yield stress is that of "
      "Johnson and Cook (1983, Proc. 7th Int. Symp. Ballistics, 541): (A + B*p**n) * "
      "(1 + C*ln(rate/referenceRate)) * (1 - T**m), with the equivalent plastic strain p, its rate "
      "(the factor is at least 1) and T = (temperature - startTemperature)/(meltTemperature - "
      "startTemperature); A is yieldStress, B hardening, n hardeningExponent, C rateFactor, m "
      "thermalExponent. Strains may be large. See the manual, Materials.";

  double yieldStress = 0;
  double hardening = 0;
  double hardeningExponent = 1;
  double offsetStrain = 0;
  HardeningChoice hardeningTable;
  double rateFactor = 0;
  double referenceRate = 1;
  double thermalExponent = 0;
  double meltTemperature = 0;
  double startTemperature = 293;
  double heatCapacity = 0;
  double heatShare = .9;
  double failureStrain = FailureLaw::kNone;
  double failureD1 = 0, failureD2 = 0, failureD3 = 0, failureD4 = 0, failureD5 = 0;
  double spallStress = FailureLaw::kNone;
  double fractureEnergy = 0;
  double weibullModulus = 0;
  double strengthScatter = 0;
  int seed = 0;
  double referenceVolume = 0;

  [[nodiscard]] PlasticMaterial constants() const {
    return {.yieldStress = yieldStress,
            .hardening = hardening,
            .hardeningExponent = hardeningExponent,
            .offsetStrain = offsetStrain,
            .table = hardeningTable.law(),
            .rateFactor = rateFactor,
            .referenceRate = referenceRate,
            .thermalExponent = thermalExponent,
            .meltTemperature = meltTemperature,
            .startTemperature = startTemperature,
            .heatCapacity = heatCapacity,
            .heatShare = heatShare,
            .failure = {.strain = failureStrain,
                        .d = {failureD1, failureD2, failureD3, failureD4, failureD5},
                        .spallStress = spallStress,
                        .energy = fractureEnergy}};
  }

 private:
  using C = PlasticFEMat;

  static Attributes ofHardening() {
    return attributeList(
        attribute("yieldStress", &C::yieldStress,
                  "A (Pa): yield stress before any plastic strain, in slow deformation at "
                  "startTemperature."),
        attribute("hardening", &C::hardening, "B (Pa); 0: no hardening."),
        attribute("hardeningExponent", &C::hardeningExponent,
                  "n, above 0 and at most 1; 1: linear hardening."),
        attribute("offsetStrain", &C::offsetStrain,
                  "p0: if it is not 0, the first factor is the power law A*(1 + p/p0)**n instead "
                  "of A + B*p**n."),
        attribute("hardeningTable", &C::hardeningTable,
                  "'none', or a list of points (plastic strain, yield stress in Pa), which "
                  "replaces the first factor: strains from 0 on, increasing, stresses not "
                  "decreasing; linear between the points, constant after the last one."));
  }

  static Attributes ofRateAndHeat() {
    return attributeList(
        attribute("rateFactor", &C::rateFactor, "C; 0: the rate has no effect."),
        attribute("referenceRate", &C::referenceRate,
                  "Plastic strain rate (1/s) up to which the second factor is 1."),
        attribute("thermalExponent", &C::thermalExponent,
                  "m; 0: the temperature has no effect on the yield stress."),
        attribute("meltTemperature", &C::meltTemperature,
                  "Temperature (K) at which the yield stress is 0; without thermalExponent it has "
                  "no effect."),
        attribute("startTemperature", &C::startTemperature,
                  "Temperature (K) of the body when it is added."),
        attribute("heatCapacity", &C::heatCapacity,
                  "Specific heat (J/(kg K)); the plastic work heats each triangle, without "
                  "conduction. 0: the temperature stays the same."),
        attribute("heatShare", &C::heatShare,
                  "Part of the plastic work that becomes heat (Taylor and Quinney)."));
  }

  static Attributes ofFailure() {
    return attributeList(
        attribute("failureStrain", &C::failureStrain,
                  "Equivalent plastic strain at which a triangle fails; with failureD1 or "
                  "failureD2 the least failure strain of their formula. inf: none."),
        attribute("failureD1", &C::failureD1,
                  "D1 of Johnson and Cook's failure strain (1985, Eng. Fract. Mech. 21, 31): "
                  "(D1 + D2*exp(D3*s)) * (1 + D4*ln(rate/referenceRate)) * (1 + D5*T), with the "
                  "mean stress over von Mises' stress s (tension positive, at most 1.5), the rate "
                  "of the plastic strain (the factor is that of at least referenceRate) and T of "
                  "the yield stress. The sum of plastic strain increments over it is the damage; "
                  "at 1 the triangle fails: its edges open as those of a BrittleFEMat, with the "
                  "traction that acts then as their strength, and with fractureEnergy. "
                  "failureD1 = failureD2 = 0: none."),
        attribute("failureD2", &C::failureD2, "D2, 0 or positive."),
        attribute("failureD3", &C::failureD3,
                  "D3, 0 or negative; papers that count pressure as positive give -D3."),
        attribute("failureD4", &C::failureD4, "D4; 0: the rate has no effect."),
        attribute("failureD5", &C::failureD5,
                  "D5; 0: the temperature has no effect; otherwise with meltTemperature."),
        attribute("spallStress", &C::spallStress,
                  "Tensile mean stress (Pa) at which a triangle fails at once; inf: none."),
        attribute("fractureEnergy", &C::fractureEnergy,
                  "Energy (J/m²) that opens a crack where the material has failed, from the "
                  "traction that acts to 0, linearly; 0: it opens at once. The plastic work until "
                  "then is not part of it."));
  }

  static Attributes ofScatter() {
    return attributeList(
        attribute("weibullModulus", &C::weibullModulus,
                  "Modulus m of a Weibull scatter from triangle to triangle of a factor of the "
                  "failure strain and of spallStress: a part 1 - exp(-(s/scale)**m) of the "
                  "triangles has a smaller factor than s. The scale is 1, or depends on "
                  "referenceVolume; 0: none."),
        attribute("strengthScatter", &C::strengthScatter,
                  "Relative half-width of a uniform scatter of that factor; 0: none."),
        attribute("seed", &C::seed, "Seed of the scatter's random numbers."),
        attribute("referenceVolume", &C::referenceVolume,
                  "V0 (m³): a triangle with the volume V has the scale (V0/V)**(1/m), so that the "
                  "least factor in a body does not depend on its mesh. 0: the scale is 1 for "
                  "triangles of any size."));
  }

 public:
  static Attributes attributes() {
    return joined({ofHardening(), ofRateAndHeat(), ofFailure(), ofScatter()});
  }
};

class FrictionalFEMat : public Published<FrictionalFEMat, Indexed<FrictionalFEMat, FEMat>, FEMat> {
 public:
  static constexpr const char* kName = "FrictionalFEMat";
  static constexpr const char* kDoc =
      "An FEMat that yields by friction, such as soil, rock and concrete under pressure: Drucker "
      "and Prager's cone, ideally plastic, with cohesion and angle of friction matched to those of "
      "Mohr and Coulomb in plane strain, where it can be used only. See the manual, Materials.";

  double cohesion = 0;
  double internalFriction = 0;
  double dilationAngle = 0;
  double tensionLimit = std::numeric_limits<double>::infinity();
  double failureStrain = FailureLaw::kNone;
  double fractureEnergy = 0;

  [[nodiscard]] PlasticMaterial constants() const {
    PlasticMaterial m;
    m.cohesion = cohesion;
    m.internalFriction = std::tan(internalFriction);
    m.dilation = std::tan(dilationAngle);
    m.tensionLimit = tensionLimit;
    m.failure.strain = failureStrain;
    m.failure.energy = fractureEnergy;
    if (fractureEnergy > 0) m.failure.spallStress = Cone(m).limit;
    return m;
  }

  static Attributes attributes() {
    using C = FrictionalFEMat;
    return attributeList(
        attribute("cohesion", &C::cohesion, "c (Pa); 0: dry sand, with internalFriction."),
        attribute("internalFriction", &C::internalFriction,
                  "phi (rad): the shear strength in plane strain is c + tan(phi)*pressure. "
                  "(frictionAngle is that of the surface, in contact.)"),
        attribute("dilationAngle", &C::dilationAngle,
                  "psi (rad), at most phi: plastic flow increases the volume as a cone of this "
                  "angle; 0: it keeps the volume."),
        attribute("tensionLimit", &C::tensionLimit,
                  "Largest tensile mean stress (Pa); inf: that of the cone's apex, "
                  "c/tan(phi)."),
        attribute("failureStrain", &C::failureStrain,
                  "Equivalent plastic strain, of any flow, at which a triangle fails; inf: none."),
        attribute("fractureEnergy", &C::fractureEnergy,
                  "Energy (J/m²) of a crack. If it is not 0, a triangle fails also where its mean "
                  "stress would exceed the largest one, tensionLimit: its edges open as those of a "
                  "BrittleFEMat, with the traction that acts then as their strength, which falls "
                  "to 0 linearly. 0: tension flows there, and after failureStrain cracks open at "
                  "once."));
  }
};

}  // namespace yadefrag
