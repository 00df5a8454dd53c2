#pragma once
// Materials of finite-element bodies. YADE's own Ip2 functors treat them as FrictMat. Their
// constants are those of lib/mesh.

#include <string>
#include <vector>

#include "materials/choices.hpp"
#include "mesh/body_material.hpp"
#include "yade/published.hpp"
#include "yade/yade.hpp"

namespace yadefrag {

class FEMat : public Published<FEMat, Indexed<FEMat, yade::FrictMat>, yade::FrictMat> {
 public:
  static constexpr const char* kName = "FEMat";
  static constexpr const char* kDoc =
      "Elastic material of a finite-element body. Young's modulus, Poisson's ratio and density are "
      "the body's; for contact with spheres they are used, with the friction angle, as those of "
      "any FrictMat.";

  bool planeStress = false;
  /// Constants of the classes below, whose attributes are those that they use.
  BrittleMaterial brittle;
  PlasticMaterial plastic;
  FailureLaw failure;
  int seed = 0;

  static Attributes attributes();
};

class BrittleFEMat : public Published<BrittleFEMat, Indexed<BrittleFEMat, FEMat>, FEMat> {
 public:
  static constexpr const char* kName = "BrittleFEMat";
  static constexpr const char* kDoc = "An FEMat that cracks.";

  SofteningChoice softening;
  std::string coarseMesh = "warn";
  RateChoice rateEffect;
  SpeedChoice speedEffect;

  static Attributes attributes();
  static void pyExtra(const yade::py::object& /*pyClass*/) { convertChoices(); }
};

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

  HardeningChoice hardeningTable;

  static Attributes attributes();
};

class FrictionalFEMat : public Published<FrictionalFEMat, Indexed<FrictionalFEMat, FEMat>, FEMat> {
 public:
  static constexpr const char* kName = "FrictionalFEMat";
  static constexpr const char* kDoc =
      "An FEMat that yields by friction, such as soil, rock and concrete under pressure: Drucker "
      "and Prager's cone, ideally plastic, with cohesion and angle of friction matched to those of "
      "Mohr and Coulomb in plane strain, where it can be used only. See the manual, Materials.";

  double internalFriction = 0;
  double dilationAngle = 0;

  static Attributes attributes();
};

/// Throws InputError for a material with wrong constants, or a brittle one that cannot crack.
[[nodiscard]] BodyMaterial bodyMaterialOf(const FEMat& material);

/// Finds materials that a script changes after bodies have been made of them: these keep the values
/// that the materials had when they were added.
class MaterialWatch {
 public:
  void add(const yade::shared_ptr<FEMat>& material);
  /// One sentence for each changed attribute of a material.
  [[nodiscard]] std::vector<std::string> sentences() const;

 private:
  struct Used {
    yade::shared_ptr<FEMat> material;
    std::vector<double> values;  // as in `valuesOf`
  };
  std::vector<Used> used_;
};

}  // namespace yadefrag
