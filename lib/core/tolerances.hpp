#pragma once
// All tolerances and thresholds of the project, each with its unit and its reason. A source file
// includes only the parts that it uses, so that a changed constant rebuilds little.

#include "core/tolerances/collider.hpp"
#include "core/tolerances/contact.hpp"
#include "core/tolerances/dynamics.hpp"
#include "core/tolerances/fracture.hpp"
#include "core/tolerances/mesh.hpp"
#include "core/tolerances/plasticity.hpp"
#include "core/tolerances/search.hpp"
#include "core/tolerances/solver.hpp"
#include "core/tolerances/spheres.hpp"
#include "core/tolerances/step.hpp"
#include "core/tolerances/surface.hpp"
#include "core/tolerances/threads.hpp"
