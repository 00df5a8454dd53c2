#pragma once
// Materials of finite-element bodies. YADE's own Ip2 functors treat them as FrictMat.

#include <string>
#include <tuple>

#include "abi/yade.hpp"
#include "fe/choices.hpp"
#include "publish/indexed.hpp"
#include "publish/published.hpp"

namespace yadefrag {

class FEMat : public Published<FEMat, Indexed<FEMat, yade::FrictMat>, yade::FrictMat> {
 public:
  static constexpr const char* kName = "FEMat";
  static constexpr const char* kDoc =
      "Elastic material of a finite-element body. Young's modulus, Poisson's ratio and density are "
      "the body's; for contact with spheres they are used, with the friction angle, as those of "
      "any "
      "FrictMat.";

  bool planeStress = false;

  static Attributes attributes() {
    return attributeList(
        attribute("planeStress", &FEMat::planeStress,
                  "Plane stress (thin plate, free to change its thickness) instead of "
                  "plane strain (held at both faces)."));
  }
};

class BrittleFEMat : public Published<BrittleFEMat, Indexed<BrittleFEMat, FEMat>, FEMat> {
 public:
  static constexpr const char* kName = "BrittleFEMat";
  static constexpr const char* kDoc = "An FEMat that cracks.";

  double tensileStrength = 0;
  double fractureEnergy = 0;
  double shearFactor = 1;
  double shearEnergyFactor = 1;
  double weibullModulus = 0;
  double strengthScatter = 0;
  int seed = 0;
  double referenceVolume = 0;
  SofteningChoice softening;
  std::string coarseMesh = "warn";
  RateChoice rateEffect;
  double rateEnergyPower = 1;

  static void pyExtra(const yade::py::object& /*pyClass*/) {
    convertChoice<SofteningChoice>(), convertChoice<RateChoice>();
    convertChoice<HardeningChoice>();
  }

 private:
  using C = BrittleFEMat;

  static Attributes ofStrength() {
    return attributeList(
        attribute("tensileStrength", &C::tensileStrength,
                  "Tensile strength ft (Pa). An edge between two triangles cracks where its normal "
                  "stress sigma (positive: tension) and its shear stress tau reach "
                  "sqrt(sigma**2 + (tau/beta)**2) = ft under tension, or "
                  "|tau| = beta*ft + tan(phi)*|sigma| under pressure (Camacho and Ortiz 1996, Int. "
                  "J. Solids Struct. 33, 2899); beta is shearFactor, phi frictionAngle. So the "
                  "cohesion of Mohr and Coulomb is c = beta*ft."),
        attribute("fractureEnergy", &C::fractureEnergy,
                  "Energy (J/m²) that opens a crack in tension; 0: it opens at once."),
        attribute("shearFactor", &C::shearFactor,
                  "beta: shear strength over tensile strength. The shear strength is "
                  "beta*tensileStrength + tan(frictionAngle)*pressure: a larger beta makes it "
                  "harder to crack in shear."),
        attribute(
            "shearEnergyFactor", &C::shearEnergyFactor,
            "kappa: energy per area that a crack dissipates in pure shear, relative to "
            "fractureEnergy, that in pure tension (Snozzi and Molinari 2013, Int. J. Numer. Meth. "
            "Eng. 93, 510). Friction between the faces dissipates additional energy. Without "
            "fractureEnergy it has no effect."));
  }

  static Attributes ofScatter() {
    return attributeList(
        attribute(
            "weibullModulus", &C::weibullModulus,
            "Modulus m of a Weibull scatter of the strength (Weibull 1951, J. Appl. Mech. 18, "
            "293): a part 1 - exp(-(s/scale)**m) of the edges is weaker than s. The scale is "
            "tensileStrength, or depends on referenceVolume; 0: none."),
        attribute("strengthScatter", &C::strengthScatter,
                  "Relative half-width of a uniform scatter of the strength; 0: none."),
        attribute("seed", &C::seed, "Seed of the scatter's random numbers."),
        attribute("referenceVolume", &C::referenceVolume,
                  "V0 (m³) for which tensileStrength is the scale of the Weibull scatter: an edge "
                  "with a volume V has the scale tensileStrength*(V0/V)**(1/m), so that "
                  "a finer mesh is not weaker. V is thickness times a third of the areas of the "
                  "edge's two triangles, so all edges together have the body's volume. 0: the "
                  "scale is tensileStrength for edges of any size, and the more edges, the weaker "
                  "the weakest. Without weibullModulus it has no effect."));
  }

  static Attributes ofLaw() {
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
            "What a body gets whose triangles, of size h, do not resolve the cohesive zone "
            "l = g*young*fractureEnergy/tensileStrength**2 (4*h > l; g: that of softening, see the "
            "manual, Fracture); strength and energy "
            "cannot both be kept. 'warn': both as given, with a message; cracks need too much "
            "load. 'strength': the strength is reduced to sqrt(l/(4*h)) of it: cracks run at "
            "the right load, and uncracked bodies break too early. 'energy': the energy is "
            "raised to 4*h/l of it: uncracked bodies have the right strength, and cracked "
            "ones carry too much. By triangle, when the body is added; a message names the "
            "values (scaling as in Bazant and Oh 1983, Materials and Structures 16, 155). Without "
            "fractureEnergy it has no effect."),
        attribute(
            "rateEffect", &C::rateEffect,
            "By which factor the strength increases with the strain rate at which an edge cracks. "
            "The rate is the mean one since the edge's traction t exceeded the strength ft of slow "
            "tests: (t - ft)/young over that time (plane strain: young/(1 - poisson**2)); the edge "
            "cracks when t reaches ft*factor(rate). 'none': 1. 'ceb-fip-2010', concrete (fib Model "
            "Code 2010, 5.1.11.2): (rate/1e-6)**0.018 up to 10 /s, 0.0062*(rate/1e-6)**(1/3) "
            "above, "
            "1 below 1e-6 /s, constant (4.15) from 300 /s on. Or a list of points (strain rate in "
            "1/s, factor), rates increasing, factors at least 1; between them log(factor) is "
            "linear in log(rate), outside the factor is that of the nearest point. It multiplies "
            "the strength that an edge has by tensileStrength, strength, jointStrength, scatter "
            "and coarseMesh, and so the cohesion shearFactor*tensileStrength, but not the "
            "friction. "
            "An edge between two materials has the effect of the weaker one, bonds have none. A "
            "crack keeps its factor."),
        attribute(
            "rateEnergyPower", &C::rateEnergyPower,
            "p: where rateEffect multiplies the strength of an edge by a factor, its "
            "fractureEnergy "
            "is multiplied by factor**p (as repow of LS-DYNA's MAT_CSCM, Murray 2007, "
            "FHWA-HRT-05-062). 1: the critical opening stays the same; 0: the energy does; 2: the "
            "length of the cohesive zone does."));
  }

 public:
  static Attributes attributes() { return joined({ofStrength(), ofScatter(), ofLaw()}); }
};

}  // namespace yadefrag
