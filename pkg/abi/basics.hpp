#pragma once
// Types used by all YADE classes declared here.

#ifdef YADEFRAG_YADE_SOURCE

#include <boost/python.hpp>

#include <lib/base/Math.hpp>

namespace yade {

namespace py = boost::python;

}  // namespace yade

#else

#include <Eigen/Dense>
#include <boost/python.hpp>
#include <boost/shared_ptr.hpp>

#include <string>
#include <vector>

static_assert(EIGEN_MAX_ALIGN_BYTES == 0,
              "compile with EIGEN_DONT_VECTORIZE and EIGEN_DONT_ALIGN, as YADE's package is");

namespace yade {

namespace py = boost::python;
using boost::shared_ptr;
using std::string;
using std::vector;

using Real = double;
using Vector3r = Eigen::Matrix<Real, 3, 1>;
using Vector3i = Eigen::Matrix<int, 3, 1>;
using Matrix3r = Eigen::Matrix<Real, 3, 3>;
using Quaternionr = Eigen::Quaternion<Real>;
using mask_t = int;

}  // namespace yade

#endif
