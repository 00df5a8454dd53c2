#pragma once

namespace yadefrag {

/// Isotropic elasticity of a plane body.
struct ElasticMaterial {
  double young = 0;  ///< Pa
  double poisson = 0;
  double density = 0;  ///< kg/m³
  bool planeStress = false;

  /// Pa, Lamé's second constant (shear modulus).
  [[nodiscard]] double shearModulus() const { return young / (2 * (1 + poisson)); }
  /// Pa, Lamé's first constant. In plane stress it has the value for which the out-of-plane stress
  /// is zero.
  [[nodiscard]] double lame() const {
    return planeStress ? young * poisson / (1 - poisson * poisson)
                       : young * poisson / ((1 + poisson) * (1 - 2 * poisson));
  }
  /// Pa, stiffness of a plane compression wave: ρc².
  [[nodiscard]] double waveModulus() const { return lame() + 2 * shearModulus(); }
};

}  // namespace yadefrag
