#pragma once
// YADE's Wall, Box and Facet as rigid boundaries for contact with finite-element bodies. They move
// as YADE's bodies do, and contact forces are applied to these.
//
// In a step the boundary moves from its position to the position that YADE's body will reach at
// constant velocity. NewtonIntegrator then applies the forces of this step, and the boundary
// follows that change in the next step: momentum is conserved exactly.

#include <cstdint>
#include <string>
#include <vector>

#include <boost/serialization/vector.hpp>

#include "abi/yade.hpp"
#include "core/errors.hpp"
#include "core/step_length.hpp"
#include "fe/entry_bodies.hpp"
#include "fe/rigid_corners.hpp"
#include "fe/rigid_outlines.hpp"
#include "step/world.hpp"

namespace yadefrag {

class RigidBodies {
 public:
  /// Adds new bodies and removes those no longer in the scene. Makes all boundaries again if one of
  /// them has another shape, enters or leaves the plane, is displaced from the position to which it
  /// would have moved, or separates from the next one. `wanted`: false removes all. `dt`: time (s)
  /// for which an integrator will move the bodies. Returns true if boundaries were made. Throws
  /// InputError if a new one overlaps a finite-element body: there are then no boundaries.
  bool follow(yade::Scene& scene, World& world, EntryBodies& entries, bool wanted, double dt);
  /// Sets the velocities for the next step. `dt`: time (s) for which an integrator will move the
  /// bodies.
  void giveVelocities(World& world, double stepDt, double dt) const;
  /// Adds the forces of the last step to YADE's bodies, with their moments.
  void giveForces(yade::Scene& scene, const World& world, const StepLength& length) const;

  [[nodiscard]] bool any() const { return !corners_.empty(); }
  /// True if any of them obeys forces.
  [[nodiscard]] bool anyMovable(const yade::Scene& scene) const;
  /// Messages about them since the last call; each is given once.
  [[nodiscard]] std::vector<std::string> takeSentences();

  template <class Archive>
  void archive(Archive& archive, const World& world);

 private:
  using Vector3r = yade::Vector3r;
  struct Member {
    yade::Body::id_t id;
    yade::shared_ptr<yade::Body> body = {};  // null after loading, until it has been found
    std::vector<double> form = {};
    bool isNew = true;  // or its shape changed: it must not overlap a body
    /// It was out of the plane when it was last checked; it may come back.
    bool isOut = false;
    Vector3r position = Vector3r::Zero();  // m
    yade::Quaternionr orientation = yade::Quaternionr::Identity();
  };

  void findBodies(const yade::Scene& scene);
  bool takeNew(const yade::Scene& scene, int mask);
  [[nodiscard]] bool holds(const yade::Scene& scene, const World& world, double dt);
  [[nodiscard]] bool areInPlace(const World& world, double dt) const;
  [[nodiscard]] static bool comesBack(Member& member);
  void build(yade::Scene& scene, World& world, EntryBodies& entries, double dt);
  [[nodiscard]] std::vector<RigidPart> parts(std::vector<std::uint32_t>& memberOf, double dt);
  [[nodiscard]] FormerCorners formerCorners(const yade::Scene& scene, const World& world) const;
  void addCorners(const RigidOutline& outline, const std::vector<std::uint32_t>& memberOf);
  void takeOut(yade::Scene& scene, World& world, EntryBodies& entries);
  [[nodiscard]] bool slideWalls(World& world);
  void warnOfUnmoved() const;
  void warnOfLight(const yade::Scene& scene, const World& world) const;

  std::vector<Member> members_;
  std::vector<RigidCorner> corners_;
  std::size_t seen_ = 0;  // number of the scene's bodies at the last check
  mutable std::vector<std::string> sentences_;
  mutable bool reportedLight_ = false;
  bool reportedFlat_ = false;
};

template <class Archive>
void RigidBodies::archive(Archive& archive, const World& world) {
  std::vector<int> ids;
  std::vector<std::uint32_t> numbers;
  std::vector<double> places;
  for (const Member& member : members_) ids.push_back(member.id);
  for (const RigidCorner& corner : corners_) {
    numbers.push_back(corner.member), numbers.push_back(corner.following);
    for (const Vector3r* v : {&corner.place, &corner.end})
      for (int i = 0; i < 3; ++i) places.push_back((*v)[i]);
  }
  archive& boost::serialization::make_nvp("rigidBodies", ids);
  archive& boost::serialization::make_nvp("rigidCorners", numbers);
  archive& boost::serialization::make_nvp("rigidPlaces", places);
  if constexpr (Archive::is_loading::value) {
    *this = {};
    const std::size_t count = world.rigidNodes().size();
    bool isValid = numbers.size() == 2 * count && places.size() == 6 * count;
    for (std::size_t i = 0; isValid && i < count; ++i) {
      const double* at = places.data() + 6 * i;
      corners_.push_back(
          {numbers[2 * i], numbers[2 * i + 1], {at[0], at[1], at[2]}, {at[3], at[4], at[5]}});
      isValid = numbers[2 * i] < ids.size() && numbers[2 * i + 1] < count;
    }
    if (!isValid)
      throw InputError(
          "The saved state of FESolver is damaged (its rigid boundaries are invalid); "
          "load another save.");
    for (const int id : ids) {
      members_.push_back({id});
      members_.back().isNew = false;
    }
  }
}

}  // namespace yadefrag
