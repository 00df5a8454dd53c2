#pragma once
// Motion and forces of the bodies in contact, in rows one behind the other.
//
// YADE's bodies, states and shapes are spread over memory, and each contact needs two of them: for
// packed spheres in random order most of the loop's time is spent on reading them in place. Rows
// are in the order in which the contacts, which a collider creates along the curve, first name
// their bodies. They are filled at the begin of each step. Sums of forces that other engines have
// added before are moved into the rows, and back at its end: they have the bits of sums to which
// each contact is added in place. Where a body has few contacts, both cost more than they
// save: bodies are read, and forces added, in place.

#include <array>
#include <atomic>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/parallel.hpp"
#include "core/request.hpp"
#include "loop/sphere_contact_kernels.hpp"

namespace yadefrag {

/// A contact and the rows of its bodies, as in the step before.
struct PairRows {
  // Null: not of the classes that the loop computes.
  yade::ScGeom* geom = nullptr;
  yade::FrictPhys* phys = nullptr;
  yade::Body::id_t id1 = yade::Body::ID_NONE;  // of the body of row1
  std::uint32_t row1 = 0;
  std::uint32_t row2 = 0;
  bool isOfSpheres = true;

  /// YADE's dispatchers may swap the bodies of a contact.
  [[nodiscard]] bool isInOrder(const yade::Interaction& contact) const {
    return id1 == contact.id1;
  }
  void matchOrder(const yade::Interaction& contact) {
    if (isInOrder(contact)) return;
    id1 = contact.id1;
    std::swap(row1, row2);
  }
  /// True: a contact that the loop computes, with the objects of the step before.
  [[nodiscard]] bool isKnown(const yade::Interaction& contact) const {
    return geom && contact.geom.get() == geom && contact.phys.get() == phys;
  }
  /// The geometry, and so many bytes of the physics.
  template <std::size_t bytes>
  [[gnu::always_inline]] void request() const {
    if (!geom) return;
    const auto* const first = reinterpret_cast<const char*>(geom);
    const auto* const second = reinterpret_cast<const char*>(phys);
    requestLine(first), requestLine(first + 64), requestLine(first + 128);
    for (std::size_t line = 0; line < bytes; line += 64) requestLine(second + line);
  }
  void note(const yade::Interaction& contact, bool isComputed, bool areSpheres) {
    isOfSpheres = areSpheres;
    geom = isComputed ? static_cast<yade::ScGeom*>(contact.geom.get()) : nullptr;
    phys = isComputed ? static_cast<yade::FrictPhys*>(contact.phys.get()) : nullptr;
  }
};

class BodyRows {
 public:
  /// What a step needs of the rows.
  enum class Use : std::uint8_t { kNone, kMotion, kMotionAndSums };
  /// What laws need besides.
  struct More {
    bool masses = false, orientations = false;
  };
  /// Reads the bodies of all rows, for `numContacts` contacts in the scene.
  void begin(yade::Scene& scene, std::size_t numContacts, Use use, const More& more, int threads);
  /// Before `begin`: all rows are made anew in this step.
  void forget() { areValid_ = false; }
  /// True: both bodies of a contact exist, and one is of this process.
  static bool isLocal(const yade::Scene& scene, const yade::Interaction& contact);
  /// False: there is no body, or a script has taken its state or its shape.
  static bool hasMotion(const yade::Body* body) { return body && body->state && body->shape; }
  /// The motion of a body that exists, for a contact that is evaluated in place; not the sums.
  static void read(const yade::Body& body, BodyRow& row);
  static BodyMass massOf(const yade::Body& body) { return {body.state->mass, body.isDynamic()}; }
  /// True: there are no rows; sums are numbered by ids.
  [[nodiscard]] bool isInPlace() const { return isInPlace_; }
  /// Makes rows for all contacts that are new since the step before.
  void findPairs(yade::Scene& scene, int threads);
  /// Number of sums: rows, or ids.
  [[nodiscard]] std::size_t numSums() const { return isInPlace_ ? numBodies_ : rows_.size(); }
  /// What is known of contact `place`. Each for one thread at once.
  [[nodiscard]] PairRows& operator()(std::size_t place) { return pairs_[place]; }
  /// True: no contact before `place` is of this body.
  [[nodiscard]] bool isFirstIn(std::uint32_t row, std::size_t place) const {
    return !isInPlace_ && firstPlaces_[row] >= place;
  }
  [[nodiscard]] const BodyRow& operator[](std::size_t row) const { return rows_[row]; }
  /// Of a row, in a step that uses masses.
  [[nodiscard]] const BodyMass& mass(std::size_t row) const { return masses_[row]; }
  /// In a step that uses orientations.
  [[gnu::always_inline]] [[nodiscard]] Orientations orientations(const PairRows& pair) const {
    return {loadFour(orientations_[pair.row1].data()), loadFour(orientations_[pair.row2].data())};
  }
  /// True: both bodies exist, and one is of this process.
  [[nodiscard]] bool isLocal(const PairRows& pair) const {
    return isLocal(flags_[pair.row1], flags_[pair.row2]);
  }

  /// Adds to the sums of a row, or of an id.
  [[gnu::always_inline]] void add(std::size_t row, const FourLanes& force,
                                  const FourLanes& torque) {
    if (!isInPlace_) {
      BodyRow& sums = rows_[row];
      return sums.setSums(sums.force() + force, sums.torque() + torque);
    }
    double *const forces = forces_[row].data(), *const torques = torques_[row].data();
    storeThree(loadThree(forces) + force, forces);
    storeThree(loadThree(torques) + torque, torques);
  }
  /// Requests what a contact needs, before its turn.
  [[gnu::always_inline]] void request(const PairRows& pair) const {
    // There may be no rows yet.
    if (more_.masses) {
      requestLine(masses_.data() + pair.row1), requestLine(masses_.data() + pair.row2);
    }
    if (more_.orientations) {
      requestLine(orientations_.data() + pair.row1), requestLine(orientations_.data() + pair.row2);
    }
    const BodyRow *const one = rows_.data() + pair.row1, *const two = rows_.data() + pair.row2;
    requestLine(one), requestLine(one->values + 8);
    requestLine(two), requestLine(two->values + 8);
  }
  /// Requests the sums of an id.
  [[gnu::always_inline]] void requestSums(std::size_t id) const {
    yadefrag::request(forces_ + id, 0, sizeof(yade::Vector3r));
    yadefrag::request(torques_ + id, 0, sizeof(yade::Vector3r));
  }
  /// Calls `law`, one of YADE's, which adds to the sums of the contact's bodies.
  template <class Law>
  bool withSums(yade::Scene& scene, const yade::Interaction& contact, const Law& law) {
    giveForce(scene, contact.id1), giveForce(scene, contact.id2);
    const bool isForce = law();
    takeForce(scene, contact.id1), takeForce(scene, contact.id2);
    return isForce;
  }
  /// Puts the sums into YADE's, in the array of the calling thread, 0. What YADE's functors have
  /// added there since `begin` is kept.
  void giveForces(yade::Scene& scene, int threads) const;

 private:
  // Share of new contacts from which all rows are made anew, in the order of the contacts.
  static constexpr std::size_t kNewShare = 8;  // 1 of 8
  // Flags of a row.
  static constexpr unsigned kExists = 1, kIsHere = 2;

  static bool isLocal(unsigned flags1, unsigned flags2) {
    return (flags1 & flags2 & kExists) != 0 && ((flags1 | flags2) & kIsHere) != 0;
  }
  static unsigned flagsOf(const yade::Scene& scene, const yade::Body* body);
  void fill(yade::Scene& scene, std::size_t numContacts, int threads);
  void fillRow(yade::Scene& scene, std::size_t id, std::size_t row);
  void requestAhead(const yade::Scene& scene, std::size_t id) const;
  void giveForce(yade::Scene& scene, yade::Body::id_t id);
  void takeForce(yade::Scene& scene, yade::Body::id_t id);
  void makePair(yade::Scene& scene, std::size_t place);
  std::uint32_t rowFor(yade::Scene& scene, yade::Body::id_t id, std::size_t place);

  bool isInPlace_ = true;
  bool areSumsUsed_ = false;
  More more_;
  bool areValid_ = false;
  std::size_t numNew_ = 0;               // contacts since all rows were made
  std::atomic<bool> areOthers_ = false;  // a body whose shape was a sphere has another one
  std::size_t numBodies_ = 0;
  std::vector<int> rowOf_;  // by body id, -1: none
  std::vector<BodyRow> rows_;
  // By row; empty where they are not used.
  std::vector<BodyMass> masses_;
  std::vector<std::array<double, 4>> orientations_;
  std::vector<unsigned char> flags_;        // by row
  std::vector<std::uint32_t> firstPlaces_;  // by row: no contact of it is before
  std::vector<PairRows> pairs_;             // by place of the contact
  // By place of the contact, shared: the address of a contact that has ended is not used again.
  std::vector<yade::shared_ptr<yade::Interaction>> contacts_;
  std::vector<PartList<std::size_t>> changedByPart_;
  std::vector<std::size_t> changed_;  // places
  // YADE's sums, by id, where these are used in place.
  yade::Vector3r* forces_ = nullptr;
  yade::Vector3r* torques_ = nullptr;
};

}  // namespace yadefrag
