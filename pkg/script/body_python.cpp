#include "script/body_python.hpp"

#include <cassert>

#include "script/arrays.hpp"
#include "script/calls.hpp"
#include "script/mesh_python.hpp"
#include "step/overlap_check.hpp"

namespace yadefrag {

namespace py = yade::py;

BrittlePlaces brittlePlacesOf(const py::object& strength, const py::object& fractureEnergy,
                              const py::object& edges, const py::object& edgeStrength,
                              const py::object& edgeEnergy) {
  BrittlePlaces places{fromArray<double>(strength), fromArray<double>(fractureEnergy), {}};
  const auto ends = fromArray<std::array<std::uint32_t, 2>>(edges);
  const auto strengths = fromArray<double>(edgeStrength);
  const auto energies = fromArray<double>(edgeEnergy);
  assert(strengths.size() == ends.size() && energies.size() == ends.size());
  for (std::size_t i = 0; i < ends.size(); ++i)
    places.joints.push_back({ends[i], strengths[i], energies[i]});
  return places;
}

py::tuple addMesh(FESolver& solver, const ScriptMesh& mesh, const py::list& materials,
                  const py::object& materialOf, const BrittlePlaces& places,
                  const py::object& velocity, const py::object& displacement,
                  const py::object& stress, const py::object& held, const py::object& smooth,
                  double thickness, bool selfContact, bool smoothed, const std::string& name) {
  BodySpec spec;
  spec.materials.ofTriangle = fromArray<std::uint32_t>(materialOf);
  spec.places = places;
  spec.velocity = fromArray<Vec2>(velocity);
  spec.displacement = fromArray<Vec2>(displacement);
  spec.stress = fromArray<std::array<double, 3>>(stress);
  spec.held = fromArray<std::uint8_t>(held);
  spec.smoothNodes = fromArray<std::uint8_t>(smooth);
  spec.thickness = thickness;
  spec.selfContact = selfContact;
  spec.element = smoothed ? ElementKind::kSmoothed : ElementKind::kLinear;
  spec.name = name;
  std::vector<yade::shared_ptr<FEMat>> own;
  for (py::ssize_t i = 0; i < py::len(materials); ++i)
    own.push_back(py::extract<yade::shared_ptr<FEMat>>(materials[i]));
  return change(solver, [&] {
    try {
      return py::make_tuple(solver.addBody(mesh, std::move(spec), own), "", 0.);
    } catch (const OverlapError& overlap) {
      return py::make_tuple(-1, overlap.what(), overlap.depth);
    }
  });
}

}  // namespace yadefrag
