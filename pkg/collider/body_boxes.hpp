#pragma once
// Bodies as boxes for the search, and boxes as their bounds.

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <typeinfo>
#include <vector>

#include "collider/sweep_rule.hpp"
#include "core/box.hpp"
#include "core/ids.hpp"
#include "core/parallel.hpp"
#include "materials/surface_segment.hpp"
#include "yade/yade.hpp"

namespace yadefrag {

enum class ShapeKind : signed char {
  kUnknown,
  kSphere,   ///< exactly YADE's Sphere: rotation does not change its bound
  kRigid,    ///< its points move only with its own body's position and orientation
  kSegment,  ///< SurfaceSegment: FESolver moves it, and requests searches
  kFollower  ///< anything else: grid connections and facets, chained cylinders, other plugins'
             ///< shapes
};

/// Tests whether objects are exactly of one class, `Exact`. YADE's classes are declared in several
/// libraries, so that `typeid` compares their names. An object with the table of virtual functions
/// of one that has passed the test passes without that.
template <class Base, class Exact>
class IsExactly {
 public:
  bool operator()(const Base& object) const {
    const void* table = nullptr;
    std::memcpy(&table, static_cast<const void*>(&object), sizeof table);
    if (table == known_.load(std::memory_order_relaxed)) return true;
    if (typeid(object) != typeid(Exact)) return false;
    known_.store(table, std::memory_order_relaxed);
    return true;
  }

 private:
  mutable std::atomic<const void*> known_ = nullptr;
};

/// Caches the kind by class index, which is cheaper to read than the class name.
class ShapeKinds {
 public:
  ShapeKind of(const yade::Shape& shape) {
    const auto index = static_cast<std::size_t>(shape.getClassIndex());
    if (index >= kinds_.size()) kinds_.resize(index + 1, ShapeKind::kUnknown);
    if (kinds_[index] == ShapeKind::kUnknown) kinds_[index] = find(shape);
    return kinds_[index];
  }

 private:
  static ShapeKind find(const yade::Shape& shape) {
    static constexpr std::array<std::string_view, 10> rigid = {
        "Facet",    "Box",      "Wall",     "Polyhedra",      "Tetra",
        "GridNode", "LevelSet", "Cylinder", "PotentialBlock", "PotentialParticle"};
    const std::string name = shape.getClassName();
    if (name == "Sphere") return ShapeKind::kSphere;
    if (name == SurfaceSegment::kName) return ShapeKind::kSegment;
    const bool isRigid = std::find(rigid.begin(), rigid.end(), name) != rigid.end();
    return isRigid ? ShapeKind::kRigid : ShapeKind::kFollower;
  }
  std::vector<ShapeKind> kinds_;
};

/// Radius and room of a body that is exactly a sphere, for the true-halo test.
struct Ball {
  yade::Vector3r centre;  ///< m, of its room
  double radius;  ///< m, radius of its bound (with aabbEnlargeFactor); negative: not a sphere
  double sweep;   ///< m, permitted displacement from the room's centre along each axis
};

/// Data for checking, between searches, bodies whose orientation affects their bound.
struct Turning {
  yade::Body::id_t id;
  yade::Quaternionr orientation;
  double reach;  ///< m, distance of the farthest point from the centre

  /// Upper bound (m) of the displacement of any of its points by the change of orientation: a point
  /// at distance R moves by up to 2R‖q − q₀‖.
  [[nodiscard]] double turnedBy(const yade::Quaternionr& now) const {
    const auto& q = now.coeffs();
    const auto& before = orientation.coeffs();
    if (q == before) return 0;
    return 2 * reach * std::min((q - before).norm(), (q + before).norm());
  }
};

class BodyBoxes {
 public:
  /// Computes all boxes, which `commit` then writes into the bounds. Throws InputError for a
  /// position that is not finite or an inverted bound (min > max); `rollBack` then restores every
  /// bound.
  void prepare(yade::Scene& scene, yade::BoundDispatcher& dispatcher, const SweepRule& rule,
               double cellSlack, int threads);
  /// Replaces `prepare` for bodies that were added, removed or changed since the last `commit`, and
  /// for those that have left their box, will have left it `rule.lookAhead` from now at their
  /// present speed, or have become so slow that the box is far too large. All others keep their
  /// boxes and bounds. `quick`: only added or removed bodies are checked. Returns false if this is
  /// too costly or impossible: more than `most` have changed, or boxes follow other bodies. The
  /// caller must then call `rollBack` and `prepare`.
  bool prepareChanged(yade::Scene& scene, yade::BoundDispatcher& dispatcher, const SweepRule& rule,
                      std::size_t most, bool quick, int threads);
  void commit(yade::Scene& scene, int threads);
  /// The body is another object now, with the same properties.
  void replace(yade::Body::id_t id, const yade::Body* before, const yade::Body* now) {
    const auto place = static_cast<std::size_t>(id);
    if (place < known_.size() && known_[place].body == before) known_[place].body = now;
  }
  /// Instead of `commit`: restores all bounds to their state before `prepare`.
  void rollBack();

  /// Bodies with new boxes since the last `commit`, ascending; valid after `prepareChanged` only.
  [[nodiscard]] const std::vector<BoxId>& changed() const { return changed_; }

  /// By body id; absent for a body without contact.
  [[nodiscard]] const std::vector<Box>& boxes() const { return boxes_; }
  [[nodiscard]] const std::vector<Ball>& balls() const { return balls_; }
  [[nodiscard]] const std::vector<Turning>& turning() const { return turning_; }
  /// By body id, 1 for a surface segment; empty if there is none.
  [[nodiscard]] const std::vector<std::uint8_t>& isSegment() const { return isSegment_; }
  /// Displacement (m) of nodes without a bound up to which the boxes that follow them are valid;
  /// infinite if there are no such boxes.
  [[nodiscard]] double followerSweep() const { return hasFollowers_ ? rule_.most : INFINITY; }
  /// True if yade.mpy has distributed the scene to several processes.
  [[nodiscard]] bool isSplit() const { return isSplit_; }
  /// True if all bodies with a bound are surface segments.
  [[nodiscard]] bool onlySegments() const { return segmentCount_ > 0 && !hasOthers_; }

 private:
  enum class Kind : unsigned char { kNone, kSphere, kOther };
  /// A bound before `prepare`: YADE's functors write into the bound itself.
  struct OldBound {
    yade::Body* body;
    bool existed;
    int lastUpdateIter = 0;
    yade::Real sweepLength = 0;
    yade::Vector3r refPos = yade::Vector3r::Zero(), min = refPos, max = refPos;

    explicit OldBound(yade::Body& body);
    void restore() const;
  };

  /// Axis (1, 2, 3) and sign of a velocity that a sphere is expected to keep; 0: none.
  using Heading = signed char;

  /// Properties of a body, besides position and size, that determine its box: they show whether the
  /// body is still the same.
  struct Known {
    const yade::Body* body = nullptr;
    yade::mask_t mask = 0;
    yade::Body::id_t clump = yade::Body::ID_NONE;
  };
  enum class Checked : unsigned char { kSame, kChanged, kOther };

  void takeRule(yade::Scene& scene, const yade::BoundDispatcher& dispatcher, const SweepRule& rule,
                double cellSlack);
  void gatherSpheres(yade::Scene& scene, int threads);
  bool gatherChanged(yade::Scene& scene, std::size_t most, bool quick, int threads);
  Checked check(const yade::Body* body, std::size_t id);
  [[nodiscard]] bool keepsBall(const yade::Body& body, const Ball& ball) const;
  bool updateChangedOthers(yade::Scene& scene, yade::BoundDispatcher& dispatcher);
  bool keepsBox(const yade::Body& body, const Turning* was);
  void keepTurning(const yade::Scene& scene, const Turning& turning);
  static void startDispatcher(yade::Scene& scene, yade::BoundDispatcher& dispatcher);
  void commitOne(yade::Scene& scene, std::size_t id);
  static void prefetchBound(const yade::Body* body);
  Kind take(const yade::Body* body, std::size_t id);
  static Heading headingOf(const yade::State& state, const Ball& was, Heading before);
  Kind takeSphere(const yade::Body& body, std::size_t id);
  void updateOthers(yade::Scene& scene, yade::BoundDispatcher& dispatcher);
  void takeOther(const yade::shared_ptr<yade::Body>& body, yade::Scene& scene);
  [[nodiscard]] std::optional<double> boundRadius(const yade::Body& body) const;
  static void prefetch(const std::vector<yade::shared_ptr<yade::Body>>& bodies, std::size_t id);
  void takeSegment(const yade::Body& body);
  double sweepOfOther(const yade::Body& body, bool hadBound);
  [[nodiscard]] bool isGoodBody(const yade::Body* body, std::size_t id) const;
  [[noreturn]] void throwBadBody(const yade::Body& body, std::size_t id) const;

  std::vector<Box> boxes_;
  std::vector<Ball> balls_;
  std::vector<Kind> kinds_;
  std::vector<Known> known_;
  std::vector<Heading> headings_;
  std::vector<BoxId> changed_;
  std::vector<BoxId> others_;  // bodies whose boxes their functors must compute
  std::vector<PartList<BoxId>> changedByPart_, othersByPart_;
  bool onlyChanged_ = false;  // `commit` writes the boxes of `changed_` only
  std::vector<Turning> turning_;
  std::vector<std::uint8_t> isSegment_;
  std::size_t segmentCount_ = 0;
  bool hasOthers_ = false;
  bool hasFollowers_ = false;
  bool isSplit_ = false;
  std::vector<OldBound> undo_;
  ShapeKinds shapeKinds_;
  IsExactly<yade::Shape, yade::Sphere> isSphere_;
  IsExactly<yade::BoundFunctor, yade::Bo1_Sphere_Aabb> isSphereFunctor_;

  // Common to all bodies of one update:
  SweepRule rule_{0, 0, 0, 0};
  const yade::Bo1_Sphere_Aabb* sphereFunctor_ = nullptr;  // null if it is not YADE's own
  const yade::Cell* cell_ = nullptr;                      // null if the scene is not periodic
  yade::Vector3r radiusFactor_, sweepFactor_;  // from lengths in space to unsheared coordinates
  double cellSlack_ = 0;
};

}  // namespace yadefrag
