#pragma once
// The longest stable step of the present mesh.

#include "dynamics/element_kernel.hpp"
#include "mesh/model.hpp"

namespace yadefrag {

/// (s) No mode of the assembled mesh is faster than the fastest of its elements alone, whose
/// frequency ω is known exactly: the leapfrog is stable up to 2/ω, and with bulk viscosity up to
/// (2/ω)(√(1+ζ²) − ζ). Between 0.6 and 1 altitudes over the wave speed c = √((λ+2μ)/ρ) for
/// triangles of good shape, which is also why altitude/c alone would not be safe.
/// Infinite without elements.
double criticalTimeStep(const Model& model, const BulkViscosity& viscosity = {}, int threads = 1);

}  // namespace yadefrag
