#pragma once
// What pkg/script adds to Python: each function is defined beside its code, in the file of its
// subject.

#include "abi/yade.hpp"

namespace yadefrag {

class FESolver;
using SolverClass = yade::py::class_<FESolver, boost::shared_ptr<FESolver>,
                                     yade::py::bases<yade::GlobalEngine>, boost::noncopyable>;

// In the module _yadefrag.
void defineBodyParts();
void defineMeshes();

// In FESolver; addPolygon and others are written in Python (python/yadefrag/fe/solver.py).
void defineArrays(SolverClass& solver);
void defineBodies(SolverClass& solver);
void defineMotions(SolverClass& solver);
void defineQuality(SolverClass& solver);
void defineResults(SolverClass& solver);

}  // namespace yadefrag
