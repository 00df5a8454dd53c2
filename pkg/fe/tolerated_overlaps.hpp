#pragma once
// Contacts with spheres that start with a large overlap. A sphere that is pressed on a boundary
// touches one piece. When a crack opens there, the adjacent piece gets a new corner, which the
// sphere overlaps at once. The spring of YADE's law would then be compressed although no force has
// done that work; that energy was up to 1.7 times the one of a sphere that breaks a wall. The
// initial overlap is therefore tolerated: it gets no force, and it decreases with the overlap.

#include <vector>

#include <boost/serialization/nvp.hpp>
#include <boost/serialization/vector.hpp>

#include "core/errors.hpp"
#include "fe/entry_bodies.hpp"

namespace yadefrag {

class ToleratedOverlaps {
 public:
  /// Finds the contacts of this step that start with an overlap. These are contacts deeper than the
  /// possible motion of their bodies, of spheres that also have an older contact with the same
  /// finite-element body. (If a sphere rolls from piece to piece, the older contact ends.)
  void findNew(const yade::Scene& scene, const EntryBodies& bodies);

  /// (J) Initial energy of the normal springs of the contacts found in this step.
  [[nodiscard]] double energyOfNew() const { return energyOfNew_; }

  /// Reduces the forces of this step: of a contact with penetration p that started with p₀ the part
  /// (p − p₀)/p remains, also of its friction. Must be called after InteractionLoop and before
  /// NewtonIntegrator. Returns true if any force has changed.
  bool reduceForces(yade::Scene& scene);

  /// Removes the contacts found in this step: their forces have already moved the spheres.
  void forgetNew();

  void clear() { overlaps_.clear(), energyOfNew_ = 0; }

  template <class Archive>
  void archive(Archive& archive);

 private:
  struct Overlap {
    yade::Body::id_t sphere, piece;
    double depth;  // m, tolerated
    bool isNew;
  };
  static bool reduce(yade::Scene& scene, Overlap& overlap);

  std::vector<Overlap> overlaps_;  // in the order of their start
  double energyOfNew_ = 0;
};

template <class Archive>
void ToleratedOverlaps::archive(Archive& archive) {
  std::vector<int> ids;
  std::vector<double> depths;
  for (const Overlap& overlap : overlaps_) {
    ids.insert(ids.end(), {overlap.sphere, overlap.piece});
    depths.push_back(overlap.depth);
  }
  archive& boost::serialization::make_nvp("overlapIds", ids);
  archive& boost::serialization::make_nvp("overlapDepths", depths);
  if constexpr (Archive::is_loading::value) {
    if (ids.size() != 2 * depths.size())
      throw InputError(
          "The saved state of FESolver is damaged (its contacts with spheres are invalid); load "
          "another save.");
    clear();
    for (std::size_t i = 0; i < depths.size(); ++i)
      overlaps_.push_back({ids[2 * i], ids[2 * i + 1], depths[i], false});
  }
}

}  // namespace yadefrag
