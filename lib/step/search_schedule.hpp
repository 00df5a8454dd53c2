#pragma once
// Between the global search, which uses boxes, and contact, which uses slaves and masters: the halo
// (paper §4.1, §4.4).
//
//   ┌───────────────────────────┐   Fig. 4: the halo of a piece, straight or an arc, is a strip of
//   │ δ   a ─────────────── b   │   width δ on both sides and beyond the ends. A slave in it is a
//   └───────────────────────────┘   candidate. Boxes of entries are enlarged by δ/2 each.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "contact/candidates.hpp"
#include "contact/contact.hpp"
#include "contact/pass_rule.hpp"
#include "core/box.hpp"
#include "core/vec2.hpp"
#include "mesh/model.hpp"
#include "search/contact_search.hpp"
#include "surface/contact_surface.hpp"
#include "time/explicit_dynamics.hpp"

namespace yadefrag {

/// Box of an entry's piece, enlarged by half the halo. If the points of two entries move by less
/// than δ/2 each before the entries touch, their boxes overlap.
Box entryBox(const ContactSurfaces& surfaces, std::span<const Vec2> positions, EntryId entry,
             double halo);

/// True if slaves of one of the two components may touch the other one.
inline bool mayTouch(const Model& model, ComponentId a, ComponentId b) {
  if (a == b) return model.components[a.value].selfContact;
  return !model.components[a.value].rigid || !model.components[b.value].rigid;
}

/// From pairs of entries with overlapping boxes, in both directions: slaves in their masters' halo
/// at `positions`, if `rule` permits them as slaves.
void selectPairs(const Model& model, const ContactSurfaces& surfaces, const PassRule& rule,
                 std::span<const Vec2> positions, double halo, std::span<const BoxPair> overlapping,
                 std::vector<SlaveMaster>& pairs);

// --- Candidates of new faces, without a search of the whole scene.

/// The entries of `sides`, of the segments before and after them, and all candidates of any of
/// these: ascending. The candidates are indexed.
std::vector<EntryId> entriesAround(const ContactSurfaces& surfaces, Candidates& candidates,
                                   std::span<const SurfaceSide> sides);

/// Pairs of these entries whose boxes, enlarged by half the halo, overlap.
std::vector<BoxPair> overlapsAmong(const ContactSurfaces& surfaces, std::span<const Vec2> positions,
                                   std::span<const EntryId> entries, double halo);

// --- The search for contact, its result and the time of the next one (paper §4.1): the only owner
// of all three. The pairs, and the bounds of entries for a collider, are valid while no node has
// left the halo. Most steps between two searches check no node, since the sum of the largest
// displacements is a sufficient bound. Independently of predictions x* is decisive: if a node has
// left the halo, a search is done in the same step.

/// Bounds between two searches. They decide in which steps nodes are checked, and with this the
/// bound of the displacement from which contact gets its tolerances: a loaded state needs the same.
struct SearchBounds {
  double farthest = INFINITY;  ///< m, distance of the checked nodes from `SearchState::positions`
  double speed = 0;            ///< m/s, of all nodes
};

/// The state of the global search: its validity.
struct SearchState {
  enum class Validity : std::uint8_t {
    kValid,
    kDue,   ///< the next step may leave the halo
    kVoid,  ///< entries were added, removed or moved: there are no valid candidates
  };

  double halo = 0;      ///< m, δ of the last search
  double shortest = 0;  ///< m, shortest boundary segment then
  Validity validity = Validity::kVoid;
  std::uint64_t count = 0;  ///< number of searches so far
  /// The checked nodes: those of all surfaces; those from cracks are the last ones.
  std::vector<NodeId> nodes;
  std::vector<Vec2> positions;  ///< m, of those nodes at the last search, or when they were added
  SearchBounds loaded;          ///< from a saved state, until the first step after loading

  [[nodiscard]] bool isVoid() const { return validity == Validity::kVoid; }
  /// True if the next step does a search.
  [[nodiscard]] bool isDue() const { return validity != Validity::kValid; }
  void makeDue() {
    if (validity == Validity::kValid) validity = Validity::kDue;
  }
  /// The next step does a search: nodes were moved from outside.
  void makeVoid() { validity = Validity::kVoid; }
};

/// Model, surfaces and contact of the step (step/state.hpp).
struct StepData;

class SearchSchedule : public SearchState {
 public:
  /// Must be called after bodies were added or removed, and after loading.
  void rebuild(const StepData& data);
  /// Must be called after nodes have changed their numbers: the next step does a search.
  void invalidate();

  // --- in the order of a step
  void begin();
  /// Before the step moves nodes.
  void boundMotion(const StepData& data, double dt);
  /// Uses x*.
  void measureMove(const StepData& data, double dt);
  /// At x*, if a node has left the halo.
  void searchIfLeft(const StepData& data, double dt);
  /// Upper bound (m) of the displacement of nodes by contact.
  void addCorrection(double most);
  /// With xⁿ⁺¹: predicts whether the next step may leave the halo.
  void foreseeSearch(const StepData& data, double dt);
  /// Restores the state at `begin`, for a refused step. Allocates no memory.
  void undo(Contact& contact);

  /// (m) Margin of bounds that a collider makes now, for contact with bodies that are not part of
  /// the world: up to the next search no checked node moves farther from its present position. 0
  /// before the first step.
  [[nodiscard]] double boundMargin() const { return halo / 2 + std::min(motion_.farthest, halo); }

  // --- at a crack
  /// Nodes of removed triangles are no longer checked.
  void removeDropped(const Model& model);
  /// A node, at `place` (m), is on the surface from now on.
  void appear(NodeId node, Vec2 place);
  /// Adds candidates among the new faces and all entries near them: a slave within the halo of an
  /// old piece beside the crack may be in the halo of a new one.
  void addCandidatesAround(const StepData& data, std::span<const SurfaceSide> sides);

  [[nodiscard]] SearchBounds bounds(const ExplicitDynamics& dynamics) const {
    return {motion_.farthest, dynamics.speedLimit()};
  }
  /// (m) Upper bound of the displacement of checked nodes from xⁿ to x*.
  [[nodiscard]] double largestMove() const { return motion_.largest; }

 private:
  /// Bounds of positions and speeds of nodes until the next search.
  struct MotionBounds {
    double largest = 0;          // m, bound for checked nodes, from xⁿ to x*
    double most = 0;             // m, bound for any node
    bool isQuiet = false;        // no body can come near another in this step
    double farthest = INFINITY;  // m, bound of the distance of surface nodes from their positions
                                 // at the last search
  };
  /// The state at the begin of the step; the second part only for a step with a search.
  struct Former {
    MotionBounds motion;
    bool hasSearched = false, hasCandidates = false;
    SearchState search;
    Candidates candidates;
  };

  void watchAll(const StepData& data);
  void updateSpeedLimit(const StepData& data, double dt);
  [[nodiscard]] double wideHalo(const ContactSettings& settings, double move) const;
  void chooseHalo(const StepData& data);
  void keep();
  void searchNow(const StepData& data, double dt);
  void considerPairs(const StepData& data, std::span<const BoxPair> overlapping);

  MotionBounds motion_;
  Former former_;
  PassRule passRule_;
  std::unique_ptr<ContactSearch> search_;
  std::vector<BoxPair> overlapping_;
  std::vector<SlaveMaster> pairs_;
  std::vector<Box> boxes_;
};

/// (m) Shortest segment, without rigid boundaries; 0 if there is none.
double shortestSegment(const Model& model, const ContactSurfaces& surfaces,
                       std::span<const Vec2> positions);

}  // namespace yadefrag
