#pragma once
// Bodies from meshes, for Python.

#include <string>

#include "abi/yade.hpp"
#include "mesh/brittle_material.hpp"

namespace yadefrag {

class FESolver;
struct ScriptMesh;

/// `_yadefrag.brittlePlaces`: strengths (Pa) and energies (J/m²) by triangle, empty for none; sides
/// of triangles, as both nodes, with values of their own.
BrittlePlaces brittlePlacesOf(const yade::py::object& strength,
                              const yade::py::object& fractureEnergy, const yade::py::object& edges,
                              const yade::py::object& edgeStrength,
                              const yade::py::object& edgeEnergy);

/// `FESolver._addMesh` of yadefrag/fe/solver.py, which has checked all input: (component, '', 0),
/// or, without any change, (-1, message, depth (m)) for a body that would overlap another one.
/// Arrays are by node, `stress` and `materialOf` (index in `materials`) by triangle; empty: none.
yade::py::tuple addMesh(FESolver& solver, const ScriptMesh& mesh, const yade::py::list& materials,
                        const yade::py::object& materialOf, const BrittlePlaces& places,
                        const yade::py::object& velocity, const yade::py::object& displacement,
                        const yade::py::object& stress, const yade::py::object& held,
                        const yade::py::object& smooth, double thickness, bool selfContact,
                        bool smoothed, const std::string& name);

}  // namespace yadefrag
