#pragma once
// The loops over the elements of a chunk that yields, compiled and chosen as those of
// element_kernel.hpp, and for AVX-512, with which flow takes .65 to .8 of the time.

#include <array>
#include <vector>

#include "elements/element_kernel.hpp"
#include "elements/plastic_return.hpp"

namespace yadefrag {

/// Copy of kLanes successive elements' state, for a step that is undone.
struct FormerLanes {
  std::uint32_t first, count;
  double edges[4][kLanes], thickness[kLanes], strain[kLanes], temperature[kLanes];

  // Not `= default`, with which emplace_back would set all values, which are written at once, to 0.
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init,modernize-use-equals-default)
  FormerLanes() {}
};

/// What a thread collects in the chunks that it computes.
struct FlowRoom {
  std::vector<FormerLanes> former;
  std::vector<Vec2> before;    ///< m, of the nodes of a chunk at the last step; may be empty
  double dissipated = 0;       ///< J
  double squaredSteepest = 0;  ///< 1/m², largest |∇N|² of triangles that have flowed
};

/// State and constants of a chunk; arrays by triangle of the model.
struct PlasticChunk {
  std::array<double*, 4> edges;
  double *thickness, *strain, *temperature;
  double* yield;    ///< Pa, slow yield stress
  double* thermal;  ///< part of it that the temperature leaves
  YieldConstants constants;
  double dt;             ///< s
  const NodeId* nodes;   ///< by local number
  const Vec2* velocity;  ///< m/s, by node of the model
  /// Pa, U'(J) by local number of the node; null: each element has its own.
  const double* pressure;
  const double* formerPressure = nullptr;  ///< Pa, at the last step, if flow changes the volume
  double* opening = nullptr;  ///< volume strain of the flow, if it changes nodal pressures
  const ElementHoops* hoops = nullptr;  ///< by index of the lanes, with an axis

  [[nodiscard]] const ElementHoops* hoopsOf(std::size_t lane) const {
    return hoops == nullptr ? nullptr : hoops + lane;
  }
  /// (m) Of the nodes of a chunk at the last step, by local number.
  const Vec2* before(const Chunk& chunk, const Vec2* position, std::vector<Vec2>& room) const;
};

/// Adds the forces (N) of a chunk; positions and forces by local node number; after `openVolumes`
/// with the nodal pressures that follow. False if an element is flat, inverted or not finite.
bool addPlasticForces(InstructionSet set, const Chunk& chunk, const ElementLanes* lanes,
                      const PlasticChunk& in, const Vec2* position, FlowRoom& room, Vec2* force);

/// Finds the openings on a cone with nodal pressures, and adds the volumes that follow as
/// `sumVolumes`.
void openVolumes(InstructionSet set, const Chunk& chunk, const ElementLanes* lanes,
                 const PlasticChunk& in, const Vec2* position, double* nodes);

/// Adds V·J (m³) of each element to its nodes, by local number, a third or by mass; V is the
/// stress-free volume.
void sumVolumes(InstructionSet set, const Chunk& chunk, const ElementLanes* lanes,
                const PlasticChunk& in, const Vec2* position, double* nodes);

}  // namespace yadefrag
