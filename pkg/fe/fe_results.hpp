#pragma once
// What FESolver tells of contacts, strains and cracks.

#include "abi/yade.hpp"

namespace yadefrag {

class FESolver;

/// (N) A pair: what contact with body b did to body a in the last step.
yade::py::tuple pairForceOf(const FESolver& solver, int a, int b);

yade::py::object strainArrayOf(const FESolver& solver);

/// A dict of arrays, one row per crack: component, other (bodies on both sides), x, y, nx, ny,
/// opening, slip (m), damage, held, start (s; nan: from the beginning).
yade::py::dict cracksOf(const FESolver& solver);

}  // namespace yadefrag
