#pragma once
// Energy balance of contact between finite-element bodies and YADE's bodies.
//
// A contact does work on both. In the leapfrog of both sides the force of step n does the work
// F·v̄Δt, v̄ = ½(vⁿ⁻½ + vⁿ⁺½), whatever gravity, damping, prescribed motion or other forces do. The
// sum of the works on both sides, of the elastic energy of the contacts and of what their friction
// has dissipated must not increase. Contact with rigid boundaries stores no energy: its works on
// both sides must be opposite.

#include <string>
#include <utility>
#include <vector>

#include "bodies/entry_bodies.hpp"
#include "bodies/node_forces.hpp"
#include "yade/any_archive.hpp"
#include "yade/yade.hpp"

namespace yadefrag {

class SceneEnergy {
 public:
  /// What moves YADE's bodies.
  struct Integrator {
    bool exists;
    bool isFirst;  ///< it has already used the forces of spheres of this step
  };
  /// Before a step of the bodies, when their forces are known: completes the last step, in
  /// which YADE's bodies have moved.
  void begin(const yade::Scene& scene, const World& world, const EntryBodies& entries,
             Integrator integrator);
  /// After it. `given`: forces on rigid boundaries.
  void end(const yade::Scene& scene, const World& world, const ContactReactions& given);
  /// The message about created energy; empty if there is none.
  [[nodiscard]] std::string message(const World& world);
  /// That about a sphere that may pass through a body.
  [[nodiscard]] std::string takeDeep() { return std::exchange(deep_, {}); }
  /// Must be called before a body is removed.
  void forget(const World& world, ComponentId component);

  /// (J) Energy that the contacts have created so far; negative: lost, but not by friction.
  [[nodiscard]] double created() const { return bySpheres() + sums_.rigid; }
  /// True if there has been any contact.
  [[nodiscard]] bool any() const { return sums_.most > 0; }

  void archive(AnyArchive& archive);

 private:
  /// The normal or tangential forces of one body's contacts.
  struct Part {
    Vec2 force;          // N, on finite-element bodies
    double moment = 0;   // N m, about the place of YADE's body
    double elastic = 0;  // J, at present
    double held = 0;     // J, the same between the last two steps
    double work = 0;     // J, on finite-element bodies in this step
    double ownWork = 0;  // J, on YADE's body, if that is known before the next step
  };
  /// One of YADE's bodies with contact in the last step.
  struct Touching {
    yade::Body::id_t id = yade::Body::ID_NONE;
    bool isRigid = false, slips = false, isSettled = false;
    bool isSpring = true;    // the law is linear: the elastic energy is known
    bool isRemoved = false;  // some of its contacts were with fragments that this step removed
    Vec2 place, velocity;    // m, m/s, before its motion
    double spin = 0;         // rad/s
    bool isPlaced = false;   // it overlaps by more than its motion in a step explains
    yade::Quaternionr orientation = yade::Quaternionr::Identity();
    Part normal, tangent;
  };
  /// One contact in this step.
  struct Piece {
    std::size_t touching;
    Stencil foot;
    EntryId entry;
    NodeId first, last;
    double normalElastic, tangentElastic;  // J
    Vec2 along, arm, normal, tangent;      // m, m, N, N
  };
  struct Sums {
    double work = 0, elastic = 0, friction = 0;  // J, of spheres
    double least = 0;                            // J, the smallest value of bySpheres()
    double rigid = 0;                            // J, of rigid boundaries
    double most = 0;                             // J, the largest energy that was there
    double reported = 0;                         // J, in the last message
    double stiffest = 0;  // (ω Δt)² of the stiffest contact of a sphere so far
    double deepest = 0;   // of a sphere's radius, the deepest overlap that a message was about
  };

  [[nodiscard]] double bySpheres() const { return sums_.work + sums_.elastic + sums_.friction; }
  [[nodiscard]] Touching touchingOf(const yade::Body& body, bool isRigid) const;
  [[nodiscard]] std::vector<Touching> contactsOf(const yade::Scene& scene, const World& world,
                                                 const EntryBodies& entries);
  void addContact(const yade::Scene& scene, const PieceGeometry& geometry, const World& world,
                  EntryId entry, const yade::Interaction& contact, const yade::Body& piece,
                  std::vector<Touching>& found);
  void measureMotion(const yade::Scene& scene, const World& world);
  void addWorks(std::vector<Touching>& now);
  void noteOverlap(const World& world, const yade::Body& body, Touching& own, double depth,
                   double approach);
  [[nodiscard]] bool isBent(const World& world) const;
  void leave(const Piece& piece);
  [[nodiscard]] double kineticEnergy(const yade::Scene& scene) const;

  Sums sums_;
  std::string deep_;
  std::vector<Touching> touching_, former_;
  std::vector<Piece> pieces_;
  Integrator integrator_ = {true, false};
  long step_ = -1;       // of the scene, at the last `end`
  bool isOpen_ = false;  // `begin` has been called without `end`: the step was refused
};

}  // namespace yadefrag
