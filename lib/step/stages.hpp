#pragma once
// Stages of a step that have a file of their own; time_step.cpp calls them in their order.

#include "step/state.hpp"

namespace yadefrag {

// --- build.cpp
/// Makes the scratch anew after bodies were added, changed or removed.
void buildIfChanged(const StepData& data);
/// Which elements are checked for cracks, by the present strengths.
void updateStressLimits(WorldState& state, ExplicitDynamics& dynamics);
/// Checked only before the first step, and when the step or the viscosity has changed or bodies
/// were added or removed. The reduction of the critical step by elements that nearly collapse is
/// checked in every step.
void requireStableStep(const StepData& data, double dt);

// --- world_drive.cpp
/// Sets the velocity of nodes with a motion such that they reach their prescribed position at the
/// end of the step.
void drive(const StepData& data, double dt);
/// Undoes `drive`.
void undoDrive(Nodes& nodes, std::span<const Vec2> driven);
/// Removes motions without nodes, e.g. those of a script that changes its motion in every step.
void removeUnusedMotions(Model& model);

// --- motion_checks.cpp
/// With larger displacements neither the search nor the deformation would be meaningful.
void requireBoundedMotion(const StepData& data, double dt);
void requireResolvedMotion(const StepData& data, double dt);
/// No force keeps a ring from shrinking through the axis.
void requireOutsideAxis(const Model& model);
/// Forces so large that their work exceeds the range of numbers.
void requireFiniteEnergy(const EnergyLedger& ledger);

// --- energy_watch.cpp
/// (J) Every step rounds all coordinates, which releases energy of springs as stiff as the critical
/// step permits. The errors of single steps are independent, so that their energies add up.
double roundingEnergy(const WorldState& state, int threads);
/// Gives messages, but does not stop the run: only the user knows its purpose.
void watchEnergy(const StepData& data);

}  // namespace yadefrag
