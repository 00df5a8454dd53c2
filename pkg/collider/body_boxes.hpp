#pragma once
// From YADE's bodies to the boxes that a search takes, and back into their bounds.

#include <cmath>
#include <optional>
#include <vector>

#include "abi/yade.hpp"
#include "collider/shape_kinds.hpp"
#include "collider/sweep_rule.hpp"
#include "core/box.hpp"

namespace yadefrag {

class SurfaceSegment;

/// Centre and radius of a body that is exactly a sphere, for the test of the true halo.
struct Ball {
  yade::Vector3r centre;
  double radius;  ///< m, that of its bound (with aabbEnlargeFactor); negative: not a sphere
  double sweep;   ///< m, how far it may move in any direction
};

/// What has to be watched between searches in bodies whose orientation matters.
struct Turning {
  yade::Body::id_t id;
  yade::Quaternionr orientation;
  double reach;  ///< m, farthest point from the centre
};

class BodyBoxes {
 public:
  /// Computes all boxes, for `commit` to write into the bounds. Throws InputError for a position
  /// that is not finite or a bound that is turned inside out; `rollBack` then restores every bound.
  void prepare(yade::Scene& scene, yade::BoundDispatcher& dispatcher, const SweepRule& rule,
               double cellSlack, int threads);
  void commit(yade::Scene& scene, int threads);
  /// Instead of `commit`: all bounds as before `prepare`.
  void rollBack();

  /// By body id; absent where a body takes no part.
  [[nodiscard]] const std::vector<Box>& boxes() const { return boxes_; }
  [[nodiscard]] const std::vector<Ball>& balls() const { return balls_; }
  [[nodiscard]] const std::vector<Turning>& turning() const { return turning_; }
  /// By body id, null where the body is no surface segment; empty if none is.
  [[nodiscard]] const std::vector<const SurfaceSegment*>& segments() const { return segments_; }
  /// How far (m) nodes without a bound may move before a box that follows them is left; infinite if
  /// there is none.
  [[nodiscard]] double followerSweep() const { return hasFollowers_ ? rule_.most : INFINITY; }
  /// True if surface segments are all there is.
  [[nodiscard]] bool onlySegments() const { return segmentCount_ > 0 && !hasOthers_; }

 private:
  enum class Kind : unsigned char { kNone, kSphere, kOther };
  /// A bound as it was before `prepare`: YADE's functors write into the bound itself.
  struct OldBound {
    yade::Body* body;
    bool existed;
    int lastUpdateIter = 0;
    yade::Real sweepLength = 0;
    yade::Vector3r refPos = yade::Vector3r::Zero(), min = refPos, max = refPos;

    explicit OldBound(yade::Body& body);
    void restore() const;
  };

  void gatherSpheres(yade::Scene& scene, int threads);
  Kind takeSphere(const yade::Body& body, std::size_t id);
  void updateOthers(yade::Scene& scene, yade::BoundDispatcher& dispatcher);
  void takeOther(const yade::shared_ptr<yade::Body>& body, yade::Scene& scene);
  [[nodiscard]] std::optional<double> boundRadius(const yade::Body& body) const;
  void takeSegment(const yade::Body& body);
  double sweepOfOther(const yade::Body& body, bool hadBound);
  void checkPositions(const yade::Scene& scene) const;

  std::vector<Box> boxes_;
  std::vector<Ball> balls_;
  std::vector<Kind> kinds_;
  std::vector<Turning> turning_;
  std::vector<const SurfaceSegment*> segments_;
  std::size_t segmentCount_ = 0;
  bool hasOthers_ = false;
  bool hasFollowers_ = false;
  std::vector<OldBound> undo_;
  ShapeKinds shapeKinds_;

  // The same for all bodies of one update:
  SweepRule rule_{0, 0, 0, 0};
  const yade::Bo1_Sphere_Aabb* sphereFunctor_ = nullptr;  // null if spheres' bounds are not YADE's
  const yade::Cell* cell_ = nullptr;                      // null if the scene is not periodic
  yade::Vector3r radiusFactor_, sweepFactor_;  // of lengths in space, in unsheared coordinates
  double cellSlack_ = 0;
};

}  // namespace yadefrag
