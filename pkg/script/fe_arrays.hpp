#pragma once
// Methods of FESolver that take or return arrays; all are copies.

#include "abi/yade.hpp"

namespace yadefrag {

class FESolver;

void takeBody(FESolver& solver, int component);

/// `FESolver._setLoads` and `_prescribe`, likewise; one velocity for each node.
void setLoads(FESolver& solver, const yade::py::object& loads);
void prescribe(FESolver& solver, const yade::py::object& nodes, int held,
               const yade::py::object& velocities);
/// `FESolver._move`: centre is a pair (m), speedX, speedY and turn are pairs of times and values,
/// empty for none, and function is None for tables only.
void prescribeMotion(FESolver& solver, const yade::py::object& nodes, int held,
                     const yade::py::tuple& centre, const yade::py::tuple& speedX,
                     const yade::py::tuple& speedY, const yade::py::tuple& turn,
                     const yade::py::object& function);

/// `FESolver._pressure`: times and values of a table, or a function (s) → Pa.
void setPressure(FESolver& solver, const yade::py::object& nodes, const yade::py::object& times,
                 const yade::py::object& values, const yade::py::object& function, bool intoCracks);
void setAbsorbing(FESolver& solver, const yade::py::object& nodes);

yade::py::object reactionsOf(const FESolver& solver);
yade::py::object loadsOf(const FESolver& solver);
yade::py::object nodesOf(const FESolver& solver);
/// `component` must exist.
yade::py::object nodesOfBody(const FESolver& solver, int component);
bool isGone(const FESolver& solver, int component);
/// Names by component, '' for those without a name.
yade::py::list namesOf(const FESolver& solver);
yade::py::object velocitiesOf(const FESolver& solver);
yade::py::object displacementsOf(const FESolver& solver);
yade::py::object massesOf(const FESolver& solver);
yade::py::object trianglesOf(const FESolver& solver);
yade::py::object stressArrayOf(const FESolver& solver);
yade::py::object componentsOf(const FESolver& solver);
yade::py::object materialNumbersOf(const FESolver& solver);
yade::py::object fragmentOf(const FESolver& solver);
yade::py::object referenceOf(const FESolver& solver);
yade::py::object contactForcesOf(const FESolver& solver);
yade::py::list surfacesOf(const FESolver& solver);
/// Number of segments, without removed ones.
std::size_t segmentsOf(const FESolver& solver);
yade::py::dict droppedOf(const FESolver& solver);
yade::py::dict energyOf(const FESolver& solver);
/// (J) Energy that the time integration has created, the largest energy that the bodies could have,
/// and the energy of rounding errors.
yade::py::tuple energyBalanceOf(const FESolver& solver);
yade::py::list warningsOf(const FESolver& solver);
yade::py::list fragmentsOf(const FESolver& solver, bool held);

}  // namespace yadefrag
