#pragma once
// The YADE bodies of surface entries: made, moved, asked for the forces on them, and taken away.

#include <vector>

#include "abi/yade.hpp"
#include "fe/materials.hpp"
#include "fe/surface_segment.hpp"
#include "step/world.hpp"

namespace yadefrag {

/// One body per entry, in the order of the entries; none for those that are gone. Its state says
/// where the middle of the piece is and how it moves and turns there, so that contacts with spheres
/// see the right velocities.
class EntryBodies {
 public:
  /// Bodies of all entries that have none yet, into the scene that `O` stands for: those of the
  /// last component, whose materials are given by number.
  void add(yade::Scene& scene, const World& world,
           const std::vector<yade::shared_ptr<FEMat>>& materials);
  /// Cracks have brought further entries, at the end: they get bodies that are like those that
  /// their component has already (material, mask, colour). Does nothing, at no cost, if there are
  /// none.
  void follow(yade::Scene& scene, const World& world);
  /// Entries of rigid boundaries have come, at the end: they have no bodies of their own.
  void addNone(const World& world);
  /// Takes the bodies of entries that are gone out of the scene; the entries keep their numbers.
  void drop(yade::Scene& scene, const World& world);
  /// Takes the bodies of a component out of the scene. To be called before the world forgets it.
  void remove(yade::Scene& scene, const World& world, ComponentId component);
  /// Forgets all entries of rigid boundaries, likewise.
  void removeRigid(yade::Scene& scene, const World& world);

  /// Throws RunError if a body is not in this scene any more.
  void requireAll(const yade::Scene& scene);
  /// Throws RunError if a body has lost its shape, its state or its material.
  void requireWhole() const;
  /// Shapes and states as of now. `dt`: what an integrator will still move the bodies by (s), 0:
  /// nothing will. `first`: of the entries from there on.
  void update(const World& world, double dt, int threads, std::size_t first = 0);
  void setHalo(double halfHalo, std::size_t first = 0);
  /// (m) What setHalo was told; NaN without bodies.
  [[nodiscard]] double halo() const;
  /// Forces and torques on the bodies, as forces on the nodes: their sum, their moment and their
  /// power are kept. Leaves `forces` empty if there are none. Throws as requireWhole.
  void collectForces(yade::Scene& scene, const World& world, std::vector<Vec2>& forces) const;

  /// none() for a body that is not one of these.
  [[nodiscard]] EntryId entryOf(yade::Body::id_t id) const {
    const auto place = static_cast<std::size_t>(id);
    return place < entries_.size() ? entries_[place] : EntryId::none();
  }
  [[nodiscard]] const std::vector<yade::Body::id_t>& ids() const { return ids_; }
  [[nodiscard]] bool hasBody(EntryId entry) const {
    return ids_[entry.value] != yade::Body::ID_NONE;
  }
  /// The first; null if there is none.
  [[nodiscard]] const yade::Body* anyBody() const;
  [[nodiscard]] const yade::Body& body(EntryId entry) const { return *bodies_[entry.value]; }

  /// For archives: the bodies are found in the scene again when they are asked for.
  void restore(std::vector<yade::Body::id_t> ids);

 private:
  void requireWhole(std::size_t entry) const;
  template <class Goes>
  void removeWhere(yade::Scene& scene, Goes goes);
  void append(yade::Scene& scene, const World& world, EntryId entry,
              const yade::shared_ptr<yade::Material>& material);
  void appendNone();
  void findBodies(const yade::Scene& scene);
  void mapEntries(std::size_t first);
  [[nodiscard]] EntryId firstOf(const World& world, ComponentId component);

  std::vector<yade::Body::id_t> ids_;
  std::vector<yade::shared_ptr<yade::Body>> bodies_;
  std::vector<yade::shared_ptr<SurfaceSegment>> shapes_;  // of the bodies
  std::vector<yade::shared_ptr<yade::State>> states_;
  std::vector<BoundaryPiece> pieces_;
  std::vector<EntryId> entries_;  // by body id
  std::vector<EntryId> firstOf_;  // by component, of those that were asked for; empty: none yet
};

}  // namespace yadefrag
