#pragma once
// The attribute FESolver.contactTolerance: a number, or the name of one.

#include <boost/serialization/nvp.hpp>

#include <string_view>

#include "core/tolerances/contact.hpp"

namespace yadefrag {

struct ToleranceChoice {
  double value = tolerance::Contact().stop;

  /// Throws InputError for an unknown name.
  [[nodiscard]] static ToleranceChoice named(std::string_view name);

  template <class Archive>
  void serialize(Archive& archive, unsigned /*version*/) {
    archive& BOOST_SERIALIZATION_NVP(value);
  }
};

/// Registers the conversions: from a str (ValueError for an unknown name) or a number, and to a
/// float.
void convertTolerance();

}  // namespace yadefrag
