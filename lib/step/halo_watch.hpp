#pragma once
// When to search for contact again (paper §4.1), and the search itself: the halo, the nodes that
// may have left it, and the bodies so far apart from all others that theirs are not watched. Most
// steps between two searches look at no node, since the sum of the largest moves is bound enough.
// Whatever was foreseen, x* decides: a search comes in the same step.

#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "contact/contact.hpp"
#include "contact/pass_rule.hpp"
#include "dynamics/explicit_dynamics.hpp"
#include "search/contact_search.hpp"
#include "step/apart_bodies.hpp"

namespace yadefrag {

/// The state of the global search: what it covers, and until when.
struct SearchState {
  double halo = 0;      ///< m, δ of the last search
  double shortest = 0;  ///< m, shortest boundary segment then
  bool isDue = true;    ///< the next step may leave the halo
  bool isVoid = true;   ///< entries came or went: there are no candidates to go on with
  /// Of the surfaces of bodies that are not apart from all others; those that came by cracks are
  /// the last ones.
  std::vector<NodeId> nodes;
  std::vector<Vec2> positions;  ///< m, of those nodes at the last search, or when they came
};

class HaloWatch : public SearchState {
 public:
  /// What is watched, and what a search changes.
  struct Scene {
    const Model& model;
    const ContactSurfaces& surfaces;
    const ContactSettings& settings;
    std::span<const Vec2> reference;  ///< m, stress-free, by node
    double finest;                    ///< m, shortest stress-free segment
    bool canTouch, hasRigid, holdsCracks;
    int threads;
    StageTimes* times;  ///< null: not measured
    ExplicitDynamics& dynamics;
    Contact& contact;
    std::uint64_t& numSearches;
  };

  /// After bodies came or went, and after loading.
  void rebuild(const Scene& scene);
  /// After nodes have changed their numbers: the next step searches.
  void forget();

  // --- in the order of a step
  void begin();
  /// Before the step moves anything.
  void foreseeMotion(const Scene& scene, double dt);
  /// From x*.
  void measureMove(const Scene& scene, double dt);
  /// At x*, if a node has left the halo.
  void searchIfLeft(const Scene& scene, double dt);
  /// Contact has moved nodes by no more than that (m).
  void addCorrection(double most);
  /// Of xⁿ⁺¹: may the next step leave the halo, or bring a body near one that was apart.
  void foreseeSearch(const Scene& scene, double dt);
  /// Back to `begin`, of a step that is refused. Needs no memory.
  void takeBack(const Scene& scene);

  // --- for a search from outside
  /// `first`: the segments before it are where, and as fast as, they were at the last call.
  void chooseHalo(const Scene& scene, double dt, SegmentId first = SegmentId(0));
  /// Half the halo around an entry's piece.
  [[nodiscard]] Box boxOf(const Model& model, const ContactSurfaces& surfaces, EntryId entry) const;
  /// `lastDt`: s, of the last step.
  void takePairs(const Scene& scene, std::span<const BoxPair> overlapping, double lastDt);

  // --- at a crack
  /// Nodes of dropped triangles are watched no more.
  void forgetDropped(const Model& model);
  /// A node is on the surface from now on, at `place` (m).
  void appear(NodeId node, Vec2 place);
  /// Candidates among entries that lie around a crack.
  void addCandidatesAround(const Scene& scene, std::span<const EntryId> around);

  /// (m) From xⁿ to x*, of a watched node; a bound.
  [[nodiscard]] double largestMove() const { return motion_.largest; }
  void addTo(Footprint& footprint) const;

 private:
  /// How far and how fast nodes are, and may be until the next search.
  struct MotionBounds {
    double largest = 0;          // m, of a watched node from xⁿ to x*; a bound
    double most = 0;             // m, of any node; a bound
    bool isQuiet = false;        // no body can come near another in this step
    double farthest = INFINITY;  // m, no surface node is farther from its place at the last search
    double fastest = 0;          // m/s, of all nodes when the halo was chosen
  };
  /// As it was when the step began; the second part only of a step that searches.
  struct Former {
    MotionBounds motion;
    double spare = 0;  // m, of bodies that are apart

    bool hasSearched = false, hasCandidates = false;
    SearchState search;
    ApartBodies apart;
    Candidates candidates;
    std::uint64_t numSearches = 0;
  };

  void watchAll(const Scene& scene);
  void watchSpeed(const Scene& scene, double dt);
  void watchApart(const Scene& scene);
  void chooseWatched(const Scene& scene);
  [[nodiscard]] double apartReach() const;
  [[nodiscard]] double wideHalo(const ContactSettings& settings, double move) const;
  void keep(const Scene& scene);
  void searchNow(const Scene& scene, double dt);
  void considerPairs(const Scene& scene, std::span<const BoxPair> overlapping,
                     std::span<const Vec2> before);

  MotionBounds motion_;
  ApartBodies apart_;
  Former former_;
  PassRule passRule_;
  std::unique_ptr<ContactSearch> search_;
  std::vector<BoxPair> overlapping_;
  std::vector<SlaveMaster> pairs_;
  std::vector<Box> boxes_;
};

/// (m) Shortest segment from `first` on that is no rigid boundary's; 0 without any.
double shortestSegment(const Model& model, const ContactSurfaces& surfaces,
                       std::span<const Vec2> positions, SegmentId first = SegmentId(0));

}  // namespace yadefrag
