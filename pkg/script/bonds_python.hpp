#pragma once
// Bonds between bodies, for Python (yadefrag/fe/bonds.py, which has checked all input).

#include "abi/yade.hpp"

namespace yadefrag {

class FESolver;

/// `FESolver._bond`: (sides, corners moved, farthest move (m), message about the mesh or '').
yade::py::tuple bondOf(FESolver& solver, int a, int b, double strength, double energy);

/// `FESolver._bondAll`: the same, and the number of sides that do not match, two bodies and a place
/// (m) of which this is true.
yade::py::tuple bondAllOf(FESolver& solver, double reach, double strength, double energy);

}  // namespace yadefrag
