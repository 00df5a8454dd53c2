#pragma once
// Attributes that are given by a name, or by their values: BrittleFEMat.softening, rateEffect and
// speedEffect and PlasticFEMat.hardeningTable by a list of points, FESolver.contactTolerance by a
// number.

#include <boost/serialization/nvp.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

#include <string>
#include <string_view>
#include <vector>

#include "core/tolerances/contact.hpp"
#include "mesh/plastic_material.hpp"
#include "mesh/rate_effect.hpp"
#include "mesh/softening_curve.hpp"

namespace yadefrag {

/// In quotes; of a long text its length.
[[nodiscard]] std::string shownText(const std::string& text);

struct LawChoice {
  std::string name;           ///< empty: points are given
  std::vector<double> table;  ///< both coordinates of each point

  template <class Archive>
  void serialize(Archive& archive, unsigned /*version*/) {
    archive& BOOST_SERIALIZATION_NVP(name) & BOOST_SERIALIZATION_NVP(table);
  }
};

struct SofteningChoice : LawChoice {
  static constexpr const char* kAttribute = "softening";
  static constexpr const char* kPoints = "opening over critical opening, traction over strength";

  SofteningChoice() : LawChoice{"linear", {}} {}
  [[nodiscard]] static SofteningCurve named(std::string_view name) { return softeningNamed(name); }
  /// Throws InputError for an unknown name or invalid points.
  [[nodiscard]] SofteningCurve law() const;
};

struct RateChoice : LawChoice {
  static constexpr const char* kAttribute = "rateEffect";
  static constexpr const char* kPoints = "strain rate in 1/s, factor of the strength";

  RateChoice() : LawChoice{"none", {}} {}
  [[nodiscard]] static RateEffect named(std::string_view name) { return rateEffectNamed(name); }
  /// Throws InputError for an unknown name or invalid points.
  [[nodiscard]] RateEffect law() const;
};

struct SpeedChoice : LawChoice {
  static constexpr const char* kAttribute = "speedEffect";
  static constexpr const char* kPoints = "speed of the crack in m/s, factor of the energy";

  SpeedChoice() : LawChoice{"none", {}} {}
  [[nodiscard]] static RateEffect named(std::string_view name);
  /// Throws InputError for an unknown name or invalid points.
  [[nodiscard]] RateEffect law() const;
};

struct HardeningChoice : LawChoice {
  static constexpr const char* kAttribute = "hardeningTable";
  static constexpr const char* kPoints = "plastic strain, yield stress in Pa";
  using Table = std::vector<HardeningPoint>;

  HardeningChoice() : LawChoice{"none", {}} {}
  [[nodiscard]] static Table named(std::string_view name);
  /// Throws InputError for an unknown name or invalid points.
  [[nodiscard]] Table law() const;
};

struct ToleranceChoice {
  double value = tolerance::Contact().stop;

  /// Throws InputError for an unknown name.
  [[nodiscard]] static ToleranceChoice named(const std::string& name);

  template <class Archive>
  void serialize(Archive& archive, unsigned /*version*/) {
    archive& BOOST_SERIALIZATION_NVP(value);
  }
};

/// Registers the conversions of these: from a str, or from pairs of numbers or a number (ValueError
/// or TypeError for others), and to a str, a list of tuples or a float.
void convertChoices();

}  // namespace yadefrag
