#pragma once
// Groups of one and two rows in closed form: most groups of a scene with many bodies.

#include "contact/box_problem.hpp"

namespace yadefrag {

/// Returns false, without a result, unless there are one or two rows that are clearly independent.
bool solveSmall(const BoxProblem& problem, BoxResult& result);

}  // namespace yadefrag
