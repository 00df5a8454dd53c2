#pragma once
// Groups of one and two rows in closed form: most groups of a scene of many bodies.

#include "contact/box_problem.hpp"

namespace yadefrag {

/// False if the rows are not one or two that are clearly independent; then nothing is said.
bool solveSmall(const BoxProblem& problem, BoxResult& result);

}  // namespace yadefrag
