#pragma once
// The longest stable step of the present mesh.

#include "dynamics/element_kernel.hpp"
#include "mesh/model.hpp"

namespace yadefrag {

/// (s) Cut every node's mass up among its elements, in any way: no mode of the assembled mesh is
/// faster than the fastest of the elements so loaded, whose frequency ω is known exactly. The
/// leapfrog is stable up to 2/ω, with bulk viscosity up to (2/ω)(√(1+ζ²) − ζ). Cut up by stiffness,
/// the bound is some 1.2 to 1.3 times below the truth. Bodies that crack get equal thirds, 1.6 to
/// 1.8 below: that is how nodes split, and an element that has come to stand alone is as fast. The
/// smallest altitude over the wave speed is no bound: a lone equilateral triangle is faster by a
/// quarter. Infinite without elements, 0 where a
/// value leaves the range of numbers.
double criticalTimeStep(const Model& model, const BulkViscosity& viscosity = {}, int threads = 1);

}  // namespace yadefrag
