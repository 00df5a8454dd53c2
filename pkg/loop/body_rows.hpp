#pragma once
// Motion and forces of the bodies in contact, in rows one behind the other.
//
// YADE's bodies, states and shapes are spread over memory, and each contact needs two of them: for
// packed spheres in random order most of the loop's time is spent on reading them in place. Rows
// are in the order in which the contacts, which a collider creates along the curve, first name
// their bodies. They are filled at the begin of each step. Sums of forces start from those that
// other engines have added before, and are given back at its end: they have the bits of sums to
// which each contact is added in place.

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
  /// Reads the bodies of all rows.
  void fill(yade::Scene& scene, int threads);
  /// Appends rows for bodies of contacts [begin, end) that have none.
  void append(const yade::Scene& scene, std::size_t begin, std::size_t end);
  /// Row of a body of a contact for which `append` was called.
  [[nodiscard]] std::size_t rowOf(yade::Body::id_t id) const {
    return static_cast<std::size_t>(rowOf_[static_cast<std::size_t>(id)]);
  }
  [[nodiscard]] const BodyRow& operator[](std::size_t row) const { return rows_[row]; }
  [[nodiscard]] std::size_t size() const { return rows_.size(); }

  /// Forces of one contact on the bodies of two rows.
  void add(std::size_t row1, std::size_t row2, const ContactForce& contact) {
    addFirst(row1, contact), addSecond(row2, contact);
  }
  void addFirst(std::size_t row, const ContactForce& contact) {
    sums_[row].force += contact.force;
    sums_[row].torque += contact.torque1;
  }
  void addSecond(std::size_t row, const ContactForce& contact) {
    sums_[row].force += -contact.force;
    sums_[row].torque += contact.torque2;
  }
  /// Puts the sums into YADE's, in the array of the calling thread, 0. What YADE's functors have
  /// added there since `fill` is kept.
  void giveForces(yade::Scene& scene) const;

 private:
  struct Sum {
    yade::Vector3r force;
    yade::Vector3r torque;
  };

  void appendOne(const yade::Scene& scene, yade::Body::id_t id);
  /// What YADE's arrays have at present.
  [[nodiscard]] static Sum given(const yade::ForceContainer& forces, yade::Body::id_t id);

  std::vector<int> rowOf_;  // by body id, -1: none
  std::vector<yade::Body::id_t> ids_;
  std::vector<BodyRow> rows_;
  std::vector<Sum> sums_;
  std::vector<Sum> starts_;  // before the first contact
  int age_ = 0;              // steps since all rows were made
};

}  // namespace yadefrag
