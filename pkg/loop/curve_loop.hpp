#pragma once
// A drop-in for YADE's InteractionLoop.

#include "loop/block_memory.hpp"
#include "loop/body_rows.hpp"
#include "loop/pair_step.hpp"
#include "yade/attribute.hpp"
#include "yade/published.hpp"

namespace yadefrag {

class ContactLoop : public yade::InteractionLoop {
 public:
  void action() override;
  /// A sentence for each kind of contact that the scene has.
  [[nodiscard]] std::string report() const;

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
            "Number of contacts in the last step whose geometry the loop computed itself; that "
            "of all others was computed by YADE's functors.",
            readonly | noSave),
        attribute("fastForces", &C::fastForces,
                  "Number of contacts in the last step whose forces the loop computed itself; "
                  "those of all "
                  "others were computed by YADE's functors. See report().",
                  readonly | noSave),
        attribute(
            "threads", &C::threads,
            "Number of threads in the last step: at most ompThreads, or all, and one for each "
            "512 interactions.",
            readonly | noSave));
  }

 private:
  using Contact = PairFunctors::Contact;
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
    std::vector<ContactEnergy> energies;
  };
  /// What one thread evaluates.
  template <class Law>
  struct Evaluation {
    const PairStep<Law>& step;
    long fast = 0;    // geometries that the loop computed
    long forces = 0;  // and forces
    typename Law::Force force = {};
    std::uint32_t row1 = 0, row2 = 0;
  };

  template <class Law>
  void run(const PairStep<Law>& step, std::size_t size);
  template <class Law>
  void requestAhead(std::size_t place, std::size_t size);
  void requestInPlace(std::size_t place, std::size_t size) const;
  template <class Law>
  void evaluate(const PairStep<Law>& step, std::size_t size);
  template <class Law>
  void evaluatePart(const PairStep<Law>& step, std::size_t size, Part& part);
  /// These return false if there is no force, or YADE's law has added it.
  template <class Law>
  bool evaluateContact(Evaluation<Law>& evaluation, std::size_t place, std::size_t size);
  template <class Law>
  [[gnu::noinline]] bool evaluateGeneral(Evaluation<Law>& evaluation, const Contact& contact,
                                         PairRows& pair);
  template <class Law>
  [[gnu::noinline]] bool evaluateInPlace(Evaluation<Law>& evaluation, const Contact& contact) const;
  void add(std::uint32_t row, const FourLanes& force, const FourLanes& torque, Part& part);
  void addLater();
  template <class Law>
  void addEnergies(typename Law::Functor& functor) const;

  BodyRows rows_;
  ContactMemory memory_;
  PairFunctors::Functors functors_ = {};  // of the last step
  std::vector<Part> parts_;
};

class CurveLoop;
using LoopClass = yade::py::class_<CurveLoop, boost::shared_ptr<CurveLoop>,
                                   yade::py::bases<yade::InteractionLoop>, boost::noncopyable>;

class CurveLoop final : public Published<CurveLoop, ContactLoop, yade::InteractionLoop> {
 public:
  static constexpr const char* kName = "CurveLoop";
  static constexpr const char* kDoc =
      "InteractionLoop for many contacts of spheres: CurveLoop([Ig2...], [Ip2...], [Law2...]), "
      "with the same arguments, functors, attributes and results. Contacts of "
      "Ig2_Sphere_Sphere_ScGeom, of spheres with facets, walls and boxes, of "
      "Law2_ScGeom_FrictPhys_CundallStrack, of "
      "Law2_ScGeom_MindlinPhys_Mindlin (while no energies are traced), of "
      "Law2_ScGeom_ViscElPhys_Basic and of "
      "Law2_ScGeom6D_CohFrictPhys_CohesionMoment are computed by the loop itself with the same "
      "formulas and the same bits; all others by YADE's functors: report() says which. Forces are "
      "added in the order of O.interactions: if all laws are of this kind, every bit is the same "
      "for any number of threads. Raises RuntimeError if no functor accepts the materials or the "
      "contact, where InteractionLoop ends the process.";
  static void pyExtra(LoopClass& loop);
};

}  // namespace yadefrag
