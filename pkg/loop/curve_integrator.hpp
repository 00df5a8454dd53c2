#pragma once
// A drop-in for YADE's NewtonIntegrator.

#include <cstddef>
#include <vector>

#include "loop/block_memory.hpp"
#include "loop/body_rotation.hpp"
#include "loop/id_ranges.hpp"
#include "loop/sphere_motion.hpp"
#include "yade/attribute.hpp"
#include "yade/published.hpp"

namespace yadefrag {

/// Forces and torques on bodies, read without a call for each body: of one step, after
/// ForceContainer::sync. YADE's arrays may end before the last body: those behind have no force.
class SummedForces {
 public:
  SummedForces() = default;
  /// `forces` may be changed by `addTo`.
  SummedForces(yade::ForceContainer& forces, std::size_t numBodies) {
    if (numBodies == 0) return;
    // A YADE without OpenMP makes its arrays longer where they end before a body.
    const auto last = static_cast<int>(numBodies) - 1;
    forces.getForce(last), forces.getTorque(last);
    forces_ = &forces.getForce(0), torques_ = &forces.getTorque(0);
    // YADE's function returns an element of its array, or for bodies behind its end another zero.
    const auto isInArray = [&](std::size_t id) {
      return &forces.getForce(static_cast<int>(id)) == forces_ + id;
    };
    std::size_t above = numBodies;
    while (size_ < above) {
      const std::size_t middle = size_ + (above - size_) / 2;
      isInArray(middle) ? size_ = middle + 1 : above = middle;
    }
  }
  [[gnu::always_inline]] [[nodiscard]] FourLanes forceOn(std::size_t id) const {
    return id < size_ ? loadThree(forces_[id].data()) : FourLanes{};
  }
  [[gnu::always_inline]] [[nodiscard]] FourLanes torqueOn(std::size_t id) const {
    return id < size_ ? loadThree(torques_[id].data()) : FourLanes{};
  }
  /// False: the array ends before the body, and nothing can be added.
  [[nodiscard]] bool has(std::size_t id) const { return id < size_; }
  /// As ForceContainer::addForceUnsynced does. Each body by one thread.
  void addTo(std::size_t id, const FourLanes& force, const FourLanes& torque) const {
    // The arrays of a container that is not constant.
    storeThree(forceOn(id) + force, const_cast<double*>(forces_[id].data()));
    storeThree(torqueOn(id) + torque, const_cast<double*>(torques_[id].data()));
  }

 private:
  const yade::Vector3r* forces_ = nullptr;
  const yade::Vector3r* torques_ = nullptr;
  std::size_t size_ = 0;
};

class MotionIntegrator : public yade::NewtonIntegrator {
 public:
  MotionIntegrator() { timingDeltas.swap(yadesDeltas_); }
  void action() override;
  /// False: NewtonIntegrator moves all bodies in this step.
  [[nodiscard]] static bool isFast(const yade::Scene& now) { return !now.trackEnergy; }
  /// While it is fast: leaves out bodies in this step that an engine has moved over it, as the
  /// integrator would. `areSearched`: a collider asks whether one has left its bound.
  void leaveOut(const yade::Scene& now, const IdRanges& moved, bool areSearched);

  long fastBodies = 0;

  static Attributes attributes() {
    using yade::Attr::noSave;
    using yade::Attr::readonly;
    return attributeList(attribute("fastBodies", &MotionIntegrator::fastBodies,
                                   "Number of bodies in the last step that the integrator moved "
                                   "itself; all others were moved by YADE's NewtonIntegrator or, "
                                   "pieces of boundaries, by their FESolver.",
                                   readonly | noSave));
  }

 private:
  /// How a step moves a body.
  enum class Way : std::uint8_t {
    kNot,
    kAsSphere,
    kApart,  // clumps, and bodies with three different moments of inertia
    kByYade,
  };
  /// Of the clump that moves now: its list of members is a tree all over the memory, which is read
  /// once.
  struct Member {
    const yade::Body* body;
    const yade::Se3r* local;
  };
  /// Results of one thread.
  struct Part {
    std::vector<Member> members;
    std::vector<yade::Body::id_t> others;  // bodies that YADE's integrator moves
    long moved = 0;
    bool isAnyBeyond = false;
  };

  void readStep(MotionStep& step) const;
  [[nodiscard]] bool turnsAsSphere(const yade::Body& body) const;
  bool findMembers(const yade::Clump& clump, std::vector<Member>& members) const;
  [[nodiscard]] Way wayOf(const yade::Body& body) const;
  void sumOfMembers(const yade::Body& body, const std::vector<Member>& members) const;
  void moveApart(const MotionStep& step, const yade::Body& body, Part& part) const;
  void moveBlock(const MotionStep& step, std::size_t begin, std::size_t end, Part& part) const;
  void moveOthers(std::vector<yade::Body::id_t>& others);
  void callYades();

  // What YADE's action measures of its parts: yade.timing would show them as parts of all the time.
  yade::shared_ptr<yade::TimingDeltas> yadesDeltas_;
  std::vector<Part> parts_;
  BodyMemory memory_;
  SummedForces forces_;
  IdRanges leftOut_;
  long leftOutIn_ = -1;  // step
  bool isLeftOutBeyond_ = false;
};

class CurveIntegrator final
    : public Published<CurveIntegrator, MotionIntegrator, yade::NewtonIntegrator> {
 public:
  static constexpr const char* kName = "CurveIntegrator";
  static constexpr const char* kDoc =
      "NewtonIntegrator for many bodies, with the same attributes and the same results to the last "
      "bit. Bodies whose rotation is integrated as a sphere's are moved by the same formulas, with "
      "vector instructions and their memory requested ahead, clumps and aspherical bodies by the "
      "same formulas; with rotAlgorithm='Omelyan1998' aspherical bodies are moved by "
      "NewtonIntegrator, and so are all bodies while O.trackEnergy is set.";
};

}  // namespace yadefrag
