#pragma once
// All state of the finite-element bodies of a scene, and the step that moves them.

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "contact/contact_state.hpp"
#include "dynamics/energy_ledger.hpp"
#include "dynamics/explicit_dynamics.hpp"
#include "mesh/model.hpp"
#include "mesh/triangle_mesh.hpp"
#include "search/contact_search.hpp"
#include "surface/contact_surface.hpp"

namespace yadefrag {

/// What `World::addBody` takes beside the mesh.
struct BodySpec {
  ElasticMaterial material;
  double friction = 0;   ///< tan of the friction angle
  double thickness = 1;  ///< m
  bool selfContact = true;
  /// By node; each empty or of the mesh's size.
  std::vector<Vec2> velocity;            ///< m/s
  std::vector<Vec2> displacement;        ///< m, from the stress-free shape
  std::vector<std::uint8_t> held;        ///< Held
  std::vector<std::uint8_t> smoothNodes; ///< of boundary nodes: on a C¹-smooth part
};

class World {
 public:
  // --- set-up
  ComponentId addBody(const TriangleMesh& mesh, const BodySpec& spec);
  void removeBody(ComponentId component);
  /// Seconds, from the present mesh; infinite without elements.
  [[nodiscard]] double criticalTimeStep() const;

  // --- one step (time_step.cpp)
  void step(double dt);

  // --- search by somebody else: a collider hands the pairs over
  /// True if the entries' boxes no longer cover what may touch in the next step.
  [[nodiscard]] bool searchIsDue() const;
  /// The box of an entry in which its contacts of the next steps are: pairs of overlapping ones are
  /// candidates.
  [[nodiscard]] Box entryBox(EntryId entry) const;
  /// Takes pairs of entries whose boxes overlap, instead of the world's own search.
  void takePairs(std::vector<BoxPair> pairs);

  Model model;
  ContactSurfaces surfaces;
  // settings, ledger, counters ... (lead writes)
};

}  // namespace yadefrag
