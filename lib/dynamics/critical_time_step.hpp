#pragma once
// The critical time step of the present mesh.

#include "dynamics/element_kernel.hpp"
#include "mesh/model.hpp"

namespace yadefrag {

/// (s) Each node's mass is divided among its elements. For any such division no mode of the
/// assembled mesh is faster than the fastest mode of a single element with its part of the masses,
/// whose frequency ω is known exactly. The leapfrog scheme is stable up to 2/ω, with bulk viscosity
/// up to (2/ω)(√(1+ζ²) − ζ). With a division by stiffness, the bound is some 1.2 to 1.3 times below
/// the exact value. Bodies that can crack get equal thirds, 1.6 to 1.8 times below: nodes split in
/// that way, and a separated element has that frequency. The smallest altitude over the wave speed
/// is not a bound: it is a quarter too long for a single equilateral triangle. The result is
/// infinite without elements, and 0 if a value overflows.
double criticalTimeStep(const Model& model, const BulkViscosity& viscosity = {}, int threads = 1);

}  // namespace yadefrag
