#pragma once
// The attribute BrittleFEMat.softening: a name, or a list of points.

#include <boost/serialization/nvp.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

#include <string>
#include <vector>

#include "mesh/softening_curve.hpp"

namespace yadefrag {

struct SofteningChoice {
  std::string name = "linear";  ///< empty: points are given
  std::vector<double> table;    ///< opening and traction of each point

  /// Throws InputError for an unknown name or invalid points.
  [[nodiscard]] SofteningCurve curve() const;

  template <class Archive>
  void serialize(Archive& archive, unsigned /*version*/) {
    archive& BOOST_SERIALIZATION_NVP(name) & BOOST_SERIALIZATION_NVP(table);
  }
};

/// Registers the conversions: from a str or pairs of numbers (ValueError or TypeError for others),
/// and to a str or a list of tuples.
void convertSoftening();

}  // namespace yadefrag
