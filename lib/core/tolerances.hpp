#pragma once
// Every tolerance and threshold of the project, with its unit and its reason: all parts. A source
// includes the parts that it uses, so that a change of one constant rebuilds little.

#include "core/tolerances/collider.hpp"
#include "core/tolerances/contact.hpp"
#include "core/tolerances/dynamics.hpp"
#include "core/tolerances/fracture.hpp"
#include "core/tolerances/mesh.hpp"
#include "core/tolerances/search.hpp"
#include "core/tolerances/solver.hpp"
#include "core/tolerances/step.hpp"
#include "core/tolerances/surface.hpp"
#include "core/tolerances/threads.hpp"
