#include "mesh/material_constants.hpp"

#include <cmath>

namespace yadefrag {
namespace {

constexpr Limits kAny = {[](double) { return true; }, ""};
constexpr Limits kFinite = {[](double v) { return std::isfinite(v); }, "finite"};
constexpr Limits kPositive = {[](double v) { return v > 0 && std::isfinite(v); },
                              "positive and finite"};
constexpr Limits kNotNegative = {[](double v) { return v >= 0 && std::isfinite(v); },
                                 "0 or positive, and finite"};
constexpr Limits kPositiveOrNone = {[](double v) { return v > 0; },
                                    "positive, or infinite for none"};

constexpr Limits notNegative(const char* words) { return {kNotNegative.hold, words}; }

}  // namespace

// The attributes of these are those of YADE's material.
Constants<ElasticMaterial> elasticConstants() {
  using M = ElasticMaterial;
  static constexpr Constant<M> kAll[] = {
      {"young", " Pa", &M::young, kPositive},
      {"poisson",
       "",
       &M::poisson,
       {[](double v) { return v > -1 && v < .5; }, "above -1 and below 0.5"}},
      {"density", " kg/m³", &M::density, kPositive},
  };
  return kAll;
}

Constants<BrittleMaterial> brittleConstants() {
  using M = BrittleMaterial;
  static constexpr Constant<M> kAll[] = {
      {"tensileStrength", " Pa", &M::tensileStrength,
       notNegative("positive and finite for a material that cracks"),
       "Tensile strength ft (Pa). An edge between two triangles cracks where its normal stress "
       "sigma (positive: tension) and its shear stress tau reach sqrt(sigma**2 + (tau/beta)**2) = "
       "ft under tension, or |tau| = beta*ft + tan(phi)*|sigma| under pressure (Camacho and Ortiz "
       "1996, Int. J. Solids Struct. 33, 2899); beta is shearFactor, phi frictionAngle. So the "
       "cohesion of Mohr and Coulomb is c = beta*ft."},
      {"fractureEnergy", " J/m²", &M::fractureEnergy,
       notNegative("positive and finite, or 0 for cracks that open at once"),
       "Energy (J/m²) that opens a crack in tension; 0: it opens at once."},
      {"shearFactor", "", &M::shearFactor, kPositive,
       "beta: shear strength over tensile strength. The shear strength is beta*tensileStrength + "
       "tan(frictionAngle)*pressure: a larger beta makes it harder to crack in shear."},
      {"shearEnergyFactor", "", &M::shearEnergyFactor, kPositive,
       "kappa: energy per area that a crack dissipates in pure shear, relative to fractureEnergy, "
       "that in pure tension (Snozzi and Molinari 2013, Int. J. Numer. Meth. Eng. 93, 510). "
       "Friction between the faces dissipates additional energy. Without fractureEnergy it has no "
       "effect."},
      {"weibullModulus", "", &M::weibullModulus,
       notNegative("positive and finite, or 0 for strengths without this scatter"),
       "Modulus m of a Weibull scatter of the strength (Weibull 1951, J. Appl. Mech. 18, 293): a "
       "part 1 - exp(-(s/scale)**m) of the edges is weaker than s. The scale is tensileStrength, "
       "or depends on referenceVolume; 0: none."},
      {"strengthScatter",
       "",
       &M::strengthScatter,
       {[](double v) { return v >= 0 && v < 1; }, "at least 0 and below 1"},
       "Relative half-width of a uniform scatter of the strength; 0: none."},
      {"referenceVolume", " m³", &M::referenceVolume,
       notNegative("positive and finite, or 0 for strengths on which the volume has no influence"),
       "V0 (m³) for which tensileStrength is the scale of the Weibull scatter: an edge with a "
       "volume V has the scale tensileStrength*(V0/V)**(1/m), so that a finer mesh is not weaker. "
       "V is thickness times a third of the areas of the edge's two triangles, so all edges "
       "together have the body's volume. 0: the scale is tensileStrength for edges of any size, "
       "and the more edges, the weaker the weakest. Without weibullModulus it has no effect."},
      // Of a factor of at most 1000, a power of at most 10 is a finite number.
      {"rateEnergyPower",
       "",
       &M::rateEnergyPower,
       {[](double v) { return v >= 0 && v <= 10; },
        "from 0, for an energy without a rate effect, to 10"},
       "p: where rateEffect multiplies the strength of an edge by a factor, its fractureEnergy is "
       "multiplied by factor**p (as repow of LS-DYNA's MAT_CSCM, Murray 2007, FHWA-HRT-05-062). 1: "
       "the critical opening stays the same; 0: the energy does; 2: the length of the cohesive "
       "zone does."},
  };
  return kAll;
}

Constants<PlasticMaterial> metalConstants() {
  using M = PlasticMaterial;
  static constexpr Constant<M> kAll[] = {
      {"yieldStress", " Pa", &M::yieldStress, kNotNegative,
       "A (Pa): yield stress before any plastic strain, in slow deformation at startTemperature."},
      {"hardening", " Pa", &M::hardening, kNotNegative, "B (Pa); 0: no hardening."},
      {"hardeningExponent",
       "",
       &M::hardeningExponent,
       {[](double v) { return v > 0 && v <= 1; }, "above 0 and at most 1"},
       "n, above 0 and at most 1; 1: linear hardening."},
      {"offsetStrain", "", &M::offsetStrain, kNotNegative,
       "p0: if it is not 0, the first factor is the power law A*(1 + p/p0)**n instead of A + "
       "B*p**n."},
      {"rateFactor", "", &M::rateFactor, kNotNegative, "C; 0: the rate has no effect."},
      {"referenceRate", " 1/s", &M::referenceRate, kPositive,
       "Plastic strain rate (1/s) up to which the second factor is 1."},
      {"thermalExponent", "", &M::thermalExponent, kNotNegative,
       "m; 0: the temperature has no effect on the yield stress."},
      {"meltTemperature", " K", &M::meltTemperature, kAny,
       "Temperature (K) at which the yield stress is 0; without thermalExponent it has no effect."},
      {"startTemperature", " K", &M::startTemperature, kNotNegative,
       "Temperature (K) of the body when it is added."},
      {"heatCapacity", " J/(kg K)", &M::heatCapacity, kNotNegative,
       "Specific heat (J/(kg K)); the plastic work heats each triangle, without conduction. 0: the "
       "temperature stays the same."},
      {"heatShare",
       "",
       &M::heatShare,
       {[](double v) { return v >= 0 && v <= 1; }, "from 0 to 1"},
       "Part of the plastic work that becomes heat (Taylor and Quinney)."},
  };
  return kAll;
}

// The attributes of both angles are the angles themselves.
Constants<PlasticMaterial> coneConstants() {
  using M = PlasticMaterial;
  static constexpr Constant<M> kAll[] = {
      {"cohesion", " Pa", &M::cohesion, kNotNegative,
       "c (Pa); 0: dry sand, with internalFriction."},
      {"internalFriction", "", &M::internalFriction, notNegative("the tangent of an angle")},
      {"dilation", "", &M::dilation, notNegative("the tangent of an angle")},
      {"tensionLimit",
       " Pa",
       &M::tensionLimit,
       {[](double v) { return v >= 0; }, "0 or positive"},
       "Largest tensile mean stress (Pa); inf: that of the cone's apex, c/tan(phi)."},
  };
  return kAll;
}

Constants<FailureLaw> failureConstants() {
  using M = FailureLaw;
  static constexpr Constant<M> kAll[] = {
      {"failureStrain", "", &M::strain, kPositiveOrNone,
       "Equivalent plastic strain at which a triangle fails; with failureD1 or failureD2 the least "
       "failure strain of their formula. inf: none."},
      {"failureD1", "", &M::d1, kFinite,
       "D1 of Johnson and Cook's failure strain (1985, Eng. Fract. Mech. 21, 31): (D1 + "
       "D2*exp(D3*s)) * (1 + D4*ln(rate/referenceRate)) * (1 + D5*T), with the mean stress over "
       "von Mises' stress s (tension positive, at most 1.5), the rate of the plastic strain (the "
       "factor is that of at least referenceRate) and T of the yield stress. The sum of plastic "
       "strain increments over it is the damage; at 1 the triangle fails: its edges open as those "
       "of a BrittleFEMat, with the traction that acts then as their strength, and with "
       "fractureEnergy. failureD1 = failureD2 = 0: none."},
      {"failureD2", "", &M::d2, kFinite, "D2, 0 or positive."},
      {"failureD3", "", &M::d3, kFinite,
       "D3, 0 or negative; papers that count pressure as positive give -D3."},
      {"failureD4", "", &M::d4, kFinite, "D4; 0: the rate has no effect."},
      {"failureD5", "", &M::d5, kFinite,
       "D5; 0: the temperature has no effect; otherwise with meltTemperature."},
      {"spallStress", " Pa", &M::spallStress, kPositiveOrNone,
       "Tensile mean stress (Pa) at which a triangle fails at once; inf: none."},
      {"fractureEnergy", " J/m²", &M::energy, kNotNegative,
       "Energy (J/m²) that opens a crack where the material has failed, from the traction that "
       "acts to 0, linearly; 0: it opens at once. The plastic work until then is not part of it."},
  };
  return kAll;
}

}  // namespace yadefrag
