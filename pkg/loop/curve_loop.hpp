#pragma once
// A drop-in for YADE's InteractionLoop.

#include "loop/body_rows.hpp"
#include "loop/pair_step.hpp"
#include "memory/block_memory.hpp"
#include "publish/attribute.hpp"
#include "publish/published.hpp"

namespace yadefrag {

class ContactLoop : public yade::InteractionLoop {
 public:
  void action() override;

  long fastGeometries = 0;
  long fastForces = 0;
  int threads = 0;

  static Attributes attributes() {
    using C = ContactLoop;
    using yade::Attr::noSave;
    using yade::Attr::readonly;
    return attributeList(
        attribute(
            "fastGeometries", &C::fastGeometries,
            "Number of contacts in the last step whose geometry the loop computed itself, as "
            "Ig2_Sphere_Sphere_ScGeom does; that of all others was computed by YADE's functors.",
            readonly | noSave),
        attribute("fastForces", &C::fastForces,
                  "Number of contacts in the last step whose forces the loop computed itself, as "
                  "Law2_ScGeom_FrictPhys_CundallStrack does; those of all others were computed by "
                  "YADE's functors.",
                  readonly | noSave),
        attribute(
            "threads", &C::threads,
            "Number of threads in the last step: at most ompThreads, or all, and one for each "
            "512 interactions.",
            readonly | noSave));
  }

 private:
  using Contact = PairStep::Contact;
  /// A force that is added to the sums of a body after the parallel loop.
  struct BodyForce {
    double force[3], torque[3];
    std::uint32_t row;  // or id
  };
  /// Contacts one behind the other, which one thread evaluates. Apart in memory, as a `PartList`.
  struct alignas(tolerance::kThreadsApart) Part {
    std::size_t begin = 0, end = 0;
    long geometries = 0;  // that the loop computed
    long forces = 0;
    std::vector<BodyForce> later;
  };
  /// What one thread evaluates.
  struct Evaluation {
    const PairStep& step;
    long fast = 0;    // geometries that the loop computed
    long forces = 0;  // and forces
    ContactForce force = {};
    std::uint32_t row1 = 0, row2 = 0;
  };

  void requestAhead(std::size_t place, std::size_t size);
  void requestInPlace(std::size_t place, std::size_t size) const;
  void evaluate(const PairStep& step, std::size_t size);
  void evaluatePart(const PairStep& step, std::size_t size, Part& part);
  /// These return false if there is no force, or YADE's law has added it.
  bool evaluateContact(Evaluation& evaluation, std::size_t place, std::size_t size);
  [[gnu::noinline]] bool evaluateOther(Evaluation& evaluation, const Contact& contact,
                                       PairRows& pair);
  [[gnu::noinline]] bool evaluateInPlace(Evaluation& evaluation, const Contact& contact) const;
  void add(std::uint32_t row, const FourLanes& force, const FourLanes& torque, Part& part);
  void addLater();

  BodyRows rows_;
  ContactMemory memory_;
  PairStep::Functors functors_ = {};  // of the last step
  std::vector<Part> parts_;
};

class CurveLoop final : public Published<CurveLoop, ContactLoop, yade::InteractionLoop> {
 public:
  static constexpr const char* kName = "CurveLoop";
  static constexpr const char* kDoc =
      "InteractionLoop for many contacts of spheres: CurveLoop([Ig2...], [Ip2...], [Law2...]), "
      "with the same arguments, functors, attributes and results. Contacts of "
      "Ig2_Sphere_Sphere_ScGeom and of Law2_ScGeom_FrictPhys_CundallStrack (while no energies are "
      "traced) are computed by the loop itself with the same formulas and the same bits; all "
      "others by YADE's functors. Forces are added in the order of O.interactions: if all laws are "
      "of this kind, every bit is the same for any number of threads. Raises RuntimeError if no "
      "functor accepts the materials or the contact, where InteractionLoop ends the process.";
};

}  // namespace yadefrag
