#pragma once
// The YADE bodies of surface entries: creation, motion, forces, removal.

#include <span>
#include <vector>

#include "loop/id_ranges.hpp"
#include "materials/materials.hpp"
#include "materials/surface_segment.hpp"
#include "step/world.hpp"
#include "surface/piece_geometry.hpp"
#include "yade/yade.hpp"

namespace yadefrag {

/// The pieces of entries at given positions (m), for contact with spheres.
class BoundaryPieces {
 public:
  /// Stores references only.
  BoundaryPieces(const ContactSurfaces& surfaces, std::span<const Vec2> positions)
      : surfaces_(surfaces), positions_(positions), geometry_(surfaces, positions) {}
  /// Without the tangents of the adjacent pieces.
  [[nodiscard]] BoundaryPiece alone(EntryId entry) const;
  [[nodiscard]] BoundaryPiece whole(EntryId entry) const;

 private:
  const ContactSurfaces& surfaces_;
  std::span<const Vec2> positions_;
  const PieceGeometry geometry_;
};

/// Of the present step, after FESolver.
struct RestOfStep {
  double dt = 0;        // s, for which bodies are still moved; 0: not at all
  bool isOurs = false;  // by FESolver itself, as an integrator would
};

/// One body per entry, in the order of the entries; none for removed entries. Its state has the
/// position of the piece's middle and the translation and rotation there, so that contacts with
/// spheres use the right velocities.
class EntryBodies {
 public:
  /// Adds bodies for all entries without one to the scene of `O`: those of the last component,
  /// whose materials are given by number.
  void add(yade::Scene& scene, const World& world,
           const std::vector<yade::shared_ptr<FEMat>>& materials);
  /// Adds bodies for the entries that cracks have appended; these bodies get the material, mask and
  /// colour of their component's existing bodies. No cost if there are no new entries.
  void follow(yade::Scene& scene, const World& world);
  /// Registers appended entries of rigid boundaries, which have no bodies.
  void addNone(const World& world);
  /// Removes the bodies of removed entries from the scene; the entries keep their numbers.
  void drop(yade::Scene& scene, const World& world);
  /// Removes the bodies of a component from the scene. Must be called before the component is
  /// removed from the world.
  void remove(yade::Scene& scene, const World& world, ComponentId component);
  /// Removes all entries of rigid boundaries, likewise.
  void removeRigid(yade::Scene& scene, const World& world);

  /// Throws RunError if a body is no longer in this scene.
  void requireAll(const yade::Scene& scene);
  /// Throws RunError if a body has no shape, state or material any more.
  void requireWhole() const;
  /// True if the masks of two bodies exclude interactions between them.
  [[nodiscard]] bool haveExcludingMasks() const;
  /// Updates shapes, with the margin of their bounds, and states. An integrator also moves bodies
  /// that obey no forces, by velocity times step. `first`: only entries from this one on.
  void update(const World& world, const RestOfStep& rest, int threads, std::size_t first = 0);
  /// True if the scene has bodies besides these: only they need bounds.
  [[nodiscard]] bool meetOthers(const yade::Scene& scene) const;
  /// Converts forces and torques on the bodies to forces on the nodes, with the same resultant,
  /// moment and power. `forces` stays empty if there are none. Throws as requireWhole.
  void collectForces(yade::Scene& scene, const World& world, std::vector<Vec2>& forces) const;

  /// Returns none() for any other body.
  [[nodiscard]] EntryId entryOf(yade::Body::id_t id) const {
    const auto place = static_cast<std::size_t>(id);
    return place < entries_.size() ? entries_[place] : EntryId::none();
  }
  [[nodiscard]] const std::vector<yade::Body::id_t>& ids() const { return ids_; }
  /// Ids of all bodies.
  [[nodiscard]] const IdRanges& idRanges();
  [[nodiscard]] bool hasBody(EntryId entry) const {
    return ids_[entry.value] != yade::Body::ID_NONE;
  }
  /// The first body; null if there is none.
  [[nodiscard]] const yade::Body* firstBody() const;
  [[nodiscard]] const yade::Body& body(EntryId entry) const { return *bodies_[entry.value].body; }

  /// For archives: the bodies are searched in the scene when they are needed.
  void restore(std::vector<yade::Body::id_t> ids);

 private:
  /// What a body had when it was added or found; null for a removed entry.
  struct Entry {
    yade::shared_ptr<yade::Body> body = {};
    yade::shared_ptr<SurfaceSegment> shape = {};
    yade::shared_ptr<yade::State> state = {};
  };
  void requireWhole(std::size_t entry) const;
  [[noreturn]] void throwMissing(const yade::Scene& scene, EntryId missing) const;
  template <class Goes>
  void removeWhere(yade::Scene& scene, Goes goes);
  void append(yade::Scene& scene, const World& world, EntryId entry,
              const yade::shared_ptr<yade::Material>& material);
  void appendNone();
  void findBodies(const yade::Scene& scene);
  void mapEntries(std::size_t first);
  [[nodiscard]] EntryId firstOf(const World& world, ComponentId component);

  std::vector<yade::Body::id_t> ids_;
  std::vector<Entry> bodies_;  // empty after loading, until they are found
  std::vector<BoundaryPiece> pieces_;
  std::vector<EntryId> entries_;  // by body id
  IdRanges idRanges_;             // computed on demand; empty: not yet
  std::vector<EntryId> firstOf_;  // by component, computed on demand; empty: none yet
};

}  // namespace yadefrag
