#pragma once
// The loops over the elements of a chunk that yields, compiled and chosen as those of
// element_kernel.hpp, and for AVX-512, with which flow takes .65 to .8 of the time.
// Metals and frictional materials in plane strain are returned in vector loops (yield_lanes.hpp,
// cone_lanes.hpp), lanes without flow in a group with flow, too; other elements that flow are
// returned one by one.

#include <array>

#include "dynamics/element_kernel.hpp"
#include "dynamics/plastic_lanes.hpp"

namespace yadefrag {

/// What the flow of some lanes adds to the sums of a chunk.
struct alignas(64) FlowSums {
  double dissipated[kLanes] = {};  ///< J
  double steepest[kLanes] = {};    ///< 1/m², largest |∇N|²
};

/// State and constants of a chunk; arrays by triangle of the model.
struct PlasticChunk {
  std::array<double*, 4> edges;
  double *thickness, *strain, *temperature;
  double* yield;    ///< Pa, slow yield stress
  double* thermal;  ///< part of it that the temperature leaves
  Cone cone;        ///< of a frictional material
  SolidModuli moduli;
  bool planeStress;
  /// Pa, U'(J) by local number of the node; null: each element has its own.
  const double* pressure;
  const double* formerPressure;  ///< Pa, the same at the last step, if flow changes the volume
  double* opening;               ///< volume strain of the flow, if it changes nodal pressures
  YieldCurve curve;
};

/// What the vector loops need once elements of a chunk reach their yield stress.
class LaneReturn {
 public:
  virtual ~LaneReturn() = default;
  /// (m) Positions at the last step, by local number.
  virtual const Vec2* before() = 0;
  /// Place for the state of a group before it flows.
  virtual FormerLanes& former() = 0;
  /// Returns the lanes from `firstElement` on for which `alone` is true.
  virtual void operator()(std::uint32_t firstElement, const std::uint16_t (&corner)[3][kLanes],
                          const std::array<bool, kLanes>& alone, TrialLanes& lanes) = 0;

  FlowSums sums;
};

/// Adds the forces (N) of a chunk; positions and forces by local node number; after `openVolumes`
/// with the nodal pressures that follow. False if an element is flat, inverted or not finite.
bool addPlasticForces(InstructionSet set, const Chunk& chunk, const ElementLanes* lanes,
                      const PlasticChunk& in, const Vec2* position, LaneReturn& flow, Vec2* force);

/// Finds the openings on a cone with nodal pressures, and adds the volumes that follow as
/// `sumVolumes`.
void openVolumes(InstructionSet set, const Chunk& chunk, const ElementLanes* lanes,
                 const PlasticChunk& in, const Vec2* position, double* nodes);

/// Adds a third of V·J (m³) of each element to its nodes, by local number; V is the stress-free
/// volume.
void sumVolumes(InstructionSet set, const Chunk& chunk, const ElementLanes* lanes,
                const PlasticChunk& in, const Vec2* position, double* nodes);

}  // namespace yadefrag
