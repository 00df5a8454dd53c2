#pragma once
// Materials of finite-element bodies. YADE's own Ip2 functors take them for FrictMat.

#include <tuple>

#include "abi/yade.hpp"
#include "publish/indexed.hpp"
#include "publish/published.hpp"

namespace yadefrag {

class FEMat : public Published<FEMat, Indexed<FEMat, yade::FrictMat>, yade::FrictMat> {
 public:
  static constexpr const char* kName = "FEMat";
  static constexpr const char* kDoc =
      "Elastic material of a finite-element body. Young's modulus, Poisson's ratio and density are "
      "the body's; a sphere that touches it sees them, and the friction angle, as those of any "
      "FrictMat.";

  bool planeStress = false;

  static constexpr auto attributes() {
    return std::tuple(attribute("planeStress", &FEMat::planeStress,
                                "Free to change its thickness (thin plate), instead of held at "
                                "both faces (plane strain)."));
  }
};

class BrittleFEMat : public Published<BrittleFEMat, Indexed<BrittleFEMat, FEMat>, FEMat> {
 public:
  static constexpr const char* kName = "BrittleFEMat";
  static constexpr const char* kDoc = "An FEMat that cracks.";

  double tensileStrength = 0;
  double fractureEnergy = 0;
  double shearFactor = 1;
  double weibullModulus = 0;
  double strengthScatter = 0;
  int seed = 0;

  static constexpr auto attributes() {
    using C = BrittleFEMat;
    return std::tuple(
        attribute("tensileStrength", &C::tensileStrength, "Stress (Pa) at which a crack starts."),
        attribute("fractureEnergy", &C::fractureEnergy,
                  "Work (J/m²) that opens a crack; 0: it opens at once."),
        attribute("shearFactor", &C::shearFactor,
                  "Weight of the shear stress beside the normal stress in the criterion (β)."),
        attribute("weibullModulus", &C::weibullModulus,
                  "Modulus of a Weibull scatter of the strength; 0: none."),
        attribute("strengthScatter", &C::strengthScatter,
                  "Relative half-width of an even scatter of the strength; 0: none."),
        attribute("seed", &C::seed, "Of the scatter's random numbers."));
  }
};

}  // namespace yadefrag
