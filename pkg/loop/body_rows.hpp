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

/// Rows of the two bodies of a contact.
struct PairRows {
  yade::Body::id_t id1 = yade::Body::ID_NONE;
  yade::Body::id_t id2 = yade::Body::ID_NONE;
  std::uint32_t row1 = 0;
  std::uint32_t row2 = 0;
};

class BodyRows {
 public:
  /// Reads the bodies of all rows, for `numContacts` contacts in the scene.
  void begin(yade::Scene& scene, std::size_t numContacts, int threads);
  /// The state of a body, for contacts that are evaluated in place.
  static BodyRow read(const yade::Scene& scene, yade::Body::id_t id);
  [[nodiscard]] bool isInPlace() const { return isInPlace_; }
  /// Rows of the bodies of contact `place`, or null if it is not known that they have rows. For
  /// several threads at once.
  [[nodiscard]] const PairRows* known(std::size_t place, const yade::Interaction& contact) const {
    const PairRows& pair = pairs_[place];
    return pair.id1 == contact.id1 && pair.id2 == contact.id2 ? &pair : nullptr;
  }
  /// The same; makes rows for bodies that have none.
  [[gnu::noinline]] const PairRows& make(yade::Scene& scene, std::size_t place,
                                         const yade::Interaction& contact);
  [[nodiscard]] const BodyRow& operator[](std::size_t row) const { return rows_[row]; }

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

  void fill(yade::Scene& scene, std::size_t numContacts, int threads);
  std::uint32_t rowFor(yade::Scene& scene, yade::Body::id_t id);
  void useOwnSums();

  bool isInPlace_ = true;
  std::vector<int> rowOf_;  // by body id, -1: none
  std::vector<yade::Body::id_t> ids_;
  std::vector<BodyRow> rows_;
  std::vector<PairRows> pairs_;  // by place of the contact
  // Of each row: sums, and what YADE had before the first contact.
  Vectors ownForces_, ownTorques_, startForces_, startTorques_;
  // The sums that are used: own or YADE's.
  yade::Vector3r* forces_ = nullptr;
  yade::Vector3r* torques_ = nullptr;
  std::size_t numSums_ = 0;
  int age_ = 0;  // steps since all rows were made
};

}  // namespace yadefrag
