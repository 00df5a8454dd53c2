#pragma once
// Results of FESolver: contacts, strains and cracks.

#include "abi/yade.hpp"

namespace yadefrag {

class FESolver;

/// (N) A pair: force of contact of body b on body a in the last step.
yade::py::tuple pairForceOf(const FESolver& solver, int a, int b);

yade::py::object strainArrayOf(const FESolver& solver);

/// A dict of arrays, one row per crack: component, other (bodies on both sides), x, y, nx, ny,
/// opening, slip (m), damage, held, start (s; nan: cracked from the start).
yade::py::dict cracksOf(const FESolver& solver);

}  // namespace yadefrag
