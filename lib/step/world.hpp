#pragma once
// The finite-element bodies of a scene, and the step that moves them.

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "fracture/bonds.hpp"
#include "fracture/conform.hpp"
#include "mesh/model.hpp"
#include "mesh/triangle_mesh.hpp"
#include "step/stages.hpp"
#include "step/state.hpp"

namespace yadefrag {

/// Properties of a body besides its mesh. Arrays are by node of the mesh; empty ones mean zeros.
struct BodySpec : BodyMaterial {
  MaterialPlaces materials;  ///< replace the one above, if there are several
  /// Of a material that yields and fails: `strength` are factors of the failure strain and of the
  /// spall stress, without joints; the scatter of `brittle` is that of these, too.
  BrittlePlaces places;
  double thickness = 1;  ///< m
  bool selfContact = true;
  bool rigid = false;  ///< only for the check of overlaps
  ElementKind element = ElementKind::kLinear;
  std::vector<Vec2> velocity;      ///< m/s
  std::vector<Vec2> displacement;  ///< m, from the stress-free shape
  /// Pa (Cauchy; xx, yy, xy), by triangle, in the shape of the mesh; empty: none.
  std::vector<std::array<double, 3>> stress;
  std::vector<double> stressAcross;       ///< Pa, by triangle, zz; empty or NaN: not given
  std::vector<std::uint8_t> held;         ///< Held
  std::vector<std::uint8_t> smoothNodes;  ///< true for boundary nodes on a C¹-smooth part
  std::string name = {};                  ///< unique, without line breaks; may be empty
};

/// Its material, or the bound of several.
[[nodiscard]] inline BodyMaterial wholeOf(const BodySpec& spec) {
  if (!spec.materials.empty()) return boundOf(spec.materials, spec.places);
  BodyMaterial one = spec;
  if (one.plastic.fails()) one.brittle = untilFailure(one.plastic.failure);
  // An elastic body cracks along its joints only.
  if (!one.brittle.cracks() && !spec.places.joints.empty())
    one.brittle.tensileStrength = kUnbreakable;
  return one;
}

/// A boundary without mass for contact with bodies, which moves by World::rigidVelocities: the
/// outline of an object without elements.
struct RigidSpec {
  TriangleMesh shape;   ///< nodes and loops; triangles inside, for the check of overlaps
  double friction = 0;  ///< coefficient
  std::string name;     ///< for messages
  bool isNew = true;    ///< false: it has contacts already, and may have remaining penetrations
};

/// The bodies of a scene. A step is a sequence of stages on its parts (time_step.cpp); what is here
/// adds, changes and removes bodies between steps.
class World : public WorldState, public Settings, public Exchange {
 public:
  /// With or without an axis (Model::axisymmetric), as long as there are no bodies: InputError
  /// otherwise.
  void setAxisymmetric(bool on);
  /// Both throw InputError before anything is changed. With an axis, nodes on it are held in x.
  ComponentId addBody(const TriangleMesh& mesh, const BodySpec& spec);
  void removeBody(ComponentId component);
  /// Throws InputError, before anything is changed, if it overlaps a body.
  ComponentId addRigid(const RigidSpec& spec);
  /// Replaces all rigid boundaries by these. `former`: by index in `rigidNodes` afterwards, the
  /// former index of the corner, `kNoCorner` for a new one; contacts of the side that begins there
  /// are kept. InputError as above: there is then no boundary.
  void replaceRigid(std::span<const RigidSpec> specs, std::span<const std::uint32_t> former);
  static constexpr std::uint32_t kNoCorner = ~std::uint32_t{0};
  /// Nodes of all rigid boundaries, ascending.
  [[nodiscard]] const std::vector<NodeId>& rigidNodes() const { return scratch_.rigidNodes; }
  [[nodiscard]] bool hasRigid() const { return !scratch_.rigidNodes.empty(); }
  /// Shifts nodes of rigid boundaries along their own lines, which changes only the ends of these:
  /// `places` (m) by index in `rigidNodes`.
  void slideRigid(std::span<const Vec2> places);
  /// Bonds the bodies from the next step on along all their present common sides, by cohesive
  /// cracks of this strength (Pa) and energy (J/m²). Sides with different ends get the same ones
  /// before (fracture/conform.hpp); `done`: by what. Returns the number of these sides. Throws
  /// InputError before anything is changed.
  std::size_t bond(ComponentId a, ComponentId b, double strength, double energy,
                   ConformPlan* done = nullptr);
  /// Bonds all bodies along all sides that are up to `reach` (m) apart. Those that cannot get the
  /// same ends are counted in the result, and not bonded.
  CommonSides bondAll(double reach, double strength, double energy, ConformPlan* done = nullptr);

  /// (N) Constant external forces by node; empty: none. InputError unless one per node, all finite.
  void setLoads(std::vector<Vec2> byNode);
  /// Applies a pressure (Pa, as a function of the simulated time), from now on, to the sides of the
  /// boundary whose two ends are among the nodes, in place of an earlier one; 0: none. It follows
  /// the sides' rotation and the split of nodes. `intoCracks`: it also acts on faces of cracks that
  /// open after this call, as soon as they are connected with sides under this pressure; otherwise
  /// these have none. Throws InputError before anything is changed.
  void setPressure(std::span<const NodeId> nodes, TimeTable value, std::uint32_t function = 0,
                   bool intoCracks = false);
  /// These sides absorb waves from now on.
  void setAbsorbing(std::span<const NodeId> nodes);
  /// From now on the nodes move at `velocity` (m/s) in the directions `held`, and freely in the
  /// others. Throws InputError before anything is changed.
  void prescribe(std::span<const NodeId> nodes, std::uint8_t held, Vec2 velocity);
  /// Prescribes a velocity (m/s) for each of the nodes.
  void prescribeEach(std::span<const NodeId> nodes, std::uint8_t held,
                     std::span<const Vec2> velocity);
  /// Prescribes a motion that begins now; one with a rotation holds both directions.
  void prescribeMotion(std::span<const NodeId> nodes, std::uint8_t held, Motion motion);

  /// One step of Δt (s), which may differ from the previous one. Throws TimeStepError for a step
  /// above the critical one, InputError if it does not resolve a crack's opening, FlatError if an
  /// element is so flat that the step must be shorter, RunError if one is inverted or a value is
  /// not finite. The state is then unchanged to the last bit: the next step has the same result as
  /// without the refused one.
  void step(double dt);

  /// (s) Of the present mesh; infinite without elements.
  [[nodiscard]] double criticalTimeStep() const;

  /// True if flow has made triangles flatter since the critical step was last computed in a step.
  [[nodiscard]] bool hasFlowed() const { return PlasticFlow::isSteeper(steepness()); }

  /// To save.
  [[nodiscard]] SearchBounds searchBounds() const {
    return scratch_.isBuilt ? search.bounds(scratch_.dynamics) : search.loaded;
  }

  /// To save.
  [[nodiscard]] PlasticFlow::Steepness steepness() const {
    return scratch_.isBuilt ? scratch_.dynamics.flow().steepness() : loadedSteepness;
  }

  /// (m/s) By node, at the begin of the last step; work of a force is that with the mean of these
  /// and the present ones. Valid until bodies are added or removed.
  [[nodiscard]] std::span<const Vec2> formerVelocities() const {
    return scratch_.dynamics.previousVelocity();
  }

  /// (J) Estimate of the energy that rounding of the coordinates has added to the bodies so far.
  [[nodiscard]] double roundingEnergy() const { return yadefrag::roundingEnergy(*this, threads); }

  /// Computes all derived data after loading.
  void rebuild();

  [[nodiscard]] std::uint64_t numSearches() const { return search.count; }

 private:
  [[nodiscard]] TriangleMesh besideAxis(TriangleMesh mesh, const BodySpec& spec) const;
  void holdOnAxis(NodeId first);
  void requireNodes(std::span<const NodeId> nodes) const;
  void requireBody(ComponentId component, const char* purpose) const;
  void requireApart(const TriangleMesh& mesh, const BodySpec& spec, const std::string& subject);
  void openJoints(std::span<const EdgeId> joints);
  CommonSides conformedSides(std::span<const ComponentId> bodies, double reach,
                             const std::function<void(const CommonSides&)>& check,
                             ConformPlan* done);
  void onDivision(const DividedSides& divided);
  void bond(const CommonSides& sides, double strength, double energy);
  std::vector<EntryId> takeOff(const std::vector<std::uint8_t>& gone,
                               std::span<const NodeId> renumbered);
  std::uint32_t rigidMotion();
  ComponentId appendRigid(const RigidSpec& spec);
  std::vector<EntryId> removeAllRigid();
  [[nodiscard]] std::vector<std::uint32_t> rigidEntries() const;
  void noteChange();

  Scratch scratch_;
};

/// Throws InputError, which states the invalid value and the valid range, unless every value is
/// valid: finite, with the correct sign, one for each node of the mesh, and no triangle with a mass
/// or stiffness out of range (body_check.cpp).
void checkBody(const TriangleMesh& mesh, const BodySpec& spec, bool axisymmetric);

}  // namespace yadefrag
