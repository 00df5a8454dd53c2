#pragma once
// The loops over the elements of a chunk that yields, compiled and chosen as those of
// element_kernel.hpp. Elements without flow are computed in vector loops; those that flow are
// returned one by one, in between.

#include <array>

#include "dynamics/element_kernel.hpp"
#include "dynamics/plastic_return.hpp"

namespace yadefrag {

/// Values of kLanes elements between the trial and the forces.
struct alignas(64) TrialLanes {
  double zx[kLanes], zy[kLanes], wx[kLanes], wy[kLanes];
  double squaredZ[kLanes], part[kLanes], across[kLanes];
  double volume[kLanes];  ///< J
  double mean[kLanes];    ///< Pa, of τ
  double kept[kLanes];    ///< part of the deviator that remains

  void set(std::size_t k, const ElasticTrial& t, double keptPart) {
    zx[k] = t.zx, zy[k] = t.zy, wx[k] = t.wx, wy[k] = t.wy;
    squaredZ[k] = t.squaredZ, part[k] = t.part, across[k] = t.across, kept[k] = keptPart;
  }
};

/// Input of a chunk; arrays by triangle of the model.
struct PlasticChunk {
  std::array<const double*, 4> edges;
  const double* thickness;
  const double* yield;  ///< Pa, slow yield stress
  double slope;         ///< √3 η of a cone, by which the mean stress reduces the yield stress
  double tensionLimit;  ///< Pa
  SolidModuli moduli;
  bool planeStress;
  /// Pa, U'(J) by local number of the node; null: each element has its own.
  const double* pressure;
};

/// Returns the elements of some lanes that reached their yield stress.
class LaneReturn {
 public:
  virtual ~LaneReturn() = default;
  /// The lanes from `firstElement` on for which `yields` is true.
  virtual void operator()(std::uint32_t firstElement, const std::uint16_t (&corner)[3][kLanes],
                          const std::array<bool, kLanes>& yields, TrialLanes& lanes) = 0;
};

/// Adds the forces (N) of a chunk; positions and forces by local node number. False if an element
/// is flat, inverted or not finite.
bool addPlasticForces(InstructionSet set, const Chunk& chunk, const ElementLanes* lanes,
                      const PlasticChunk& in, const Vec2* position, LaneReturn& flow, Vec2* force);

/// Adds a third of V·J (m³) of each element to its nodes, by local number; V is the stress-free
/// volume.
void sumVolumes(InstructionSet set, const Chunk& chunk, const ElementLanes* lanes,
                const PlasticChunk& in, const Vec2* position, double* nodes);

}  // namespace yadefrag
