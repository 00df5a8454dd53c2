#pragma once
// Motion and forces of the bodies in contact, in rows one behind the other.
//
// YADE's bodies, states and shapes are spread over memory, and each contact needs two of them: with
// 470,000 contacts of 10^5 spheres in random order, reading them in place takes three times as long
// as the whole loop with rows. Rows are in the order in which the contacts, which a collider
// creates along the curve, first name their bodies. They are filled at the begin of each step; the
// sums of forces are added to YADE's at its end. So the sum of a body has the same bits wherever
// its row is.

#include <cstddef>
#include <span>
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
  void fill(const yade::Scene& scene, int threads);
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
  /// Adds the sums to those of YADE, in the array of the calling thread, 0.
  void giveForces(yade::Scene& scene) const;

 private:
  struct Sum {
    yade::Vector3r force = yade::Vector3r::Zero();
    yade::Vector3r torque = yade::Vector3r::Zero();
  };

  void appendOne(const yade::Scene& scene, yade::Body::id_t id);

  std::vector<int> rowOf_;  // by body id, -1: none
  std::vector<yade::Body::id_t> ids_;
  std::vector<BodyRow> rows_;
  std::vector<Sum> sums_;
  int age_ = 0;  // steps since all rows were made
};

}  // namespace yadefrag
