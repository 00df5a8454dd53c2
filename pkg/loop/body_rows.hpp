#pragma once
// Motion and forces of the bodies in contact, in rows one behind the other.
//
// YADE's bodies, states and shapes are spread over memory, and each contact needs two of them: for
// packed spheres in random order most of the loop's time is spent on reading them in place. Rows
// are in the order in which the contacts, which a collider creates along the curve, first name
// their bodies. They are filled at the begin of each step. Sums of forces start from those that
// other engines have added before, and are given back at its end: they have the bits of sums to
// which each contact is added in place. Where a body has few contacts, both cost more than they
// save: bodies are read, and forces added, in place.

#include <cstddef>
#include <vector>

#include "loop/sphere_contact_kernels.hpp"

namespace yadefrag {

/// State of a body at the begin of the step; `body` is null if it was erased.
struct BodyRow {
  SphereMotion motion;
  const yade::Body* body = nullptr;
  int subdomain = 0;  // of YADE's MPI engine
};

class BodyRows {
 public:
  /// Reads the bodies of all rows, for `numContacts` contacts in the scene.
  void begin(yade::Scene& scene, std::size_t numContacts, int threads);
  /// Appends rows for bodies of contacts [begin, end) that have none; nothing without rows.
  void append(yade::Scene& scene, std::size_t begin, std::size_t end);
  [[nodiscard]] bool isInPlace() const { return isInPlace_; }
  /// Row of a body of a contact for which `append` was called, or its id.
  [[nodiscard]] std::size_t rowOf(yade::Body::id_t id) const {
    const auto index = static_cast<std::size_t>(id);
    return isInPlace_ ? index : static_cast<std::size_t>(rowOf_[index]);
  }
  /// The state of such a body; `scratch` may be used for it.
  const BodyRow& get(const yade::Scene& scene, yade::Body::id_t id, BodyRow& scratch) const {
    if (!isInPlace_) return rows_[rowOf(id)];
    return scratch = read(scene, id);
  }

  void addFirst(std::size_t row, const ContactForce& contact) {
    forces_[row] += contact.force;
    torques_[row] += contact.torque1;
  }
  void addSecond(std::size_t row, const ContactForce& contact) {
    forces_[row] += -contact.force;
    torques_[row] += contact.torque2;
  }
  /// Number of sums: rows, or ids.
  [[nodiscard]] std::size_t numSums() const { return numSums_; }
  /// Puts the sums into YADE's, in the array of the calling thread, 0. What YADE's functors have
  /// added there since `begin` is kept.
  void giveForces(yade::Scene& scene) const;

 private:
  using Vectors = std::vector<yade::Vector3r>;

  static BodyRow read(const yade::Scene& scene, yade::Body::id_t id);
  void fill(yade::Scene& scene, int threads);
  void appendOne(yade::Scene& scene, yade::Body::id_t id);
  void useOwnSums();

  bool isInPlace_ = true;
  std::vector<int> rowOf_;  // by body id, -1: none
  std::vector<yade::Body::id_t> ids_;
  std::vector<BodyRow> rows_;
  // Of each row: sums, and what YADE had before the first contact.
  Vectors ownForces_, ownTorques_, startForces_, startTorques_;
  // The sums that are used: own or YADE's.
  yade::Vector3r* forces_ = nullptr;
  yade::Vector3r* torques_ = nullptr;
  std::size_t numSums_ = 0;
  int age_ = 0;  // steps since all rows were made
};

}  // namespace yadefrag
