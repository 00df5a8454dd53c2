#pragma once
// The loops over the elements of a chunk with smoothed strains. There are two passes: gradients to
// nodes, then stresses from nodes. As in element_kernel.hpp, every instruction set gives the same
// bits.

#include <vector>

#include "dynamics/element_kernel.hpp"
#include "dynamics/smoothed_law.hpp"

namespace yadefrag {

/// c and d of kLanes elements, stored by the first pass for the second.
struct alignas(64) DistortionLanes {
  double part[2][kLanes];
};

/// Adds the gradients, multiplied by a third of the volume (m³), to `nodes` (by local number),
/// stores the distortions, and appends the ranges of stressed elements as `addElasticForces` does.
/// Returns false if an element is inverted or not finite.
bool sumGradients(InstructionSet set, const Chunk& chunk, const ElementLanes* lanes,
                  const Vec2* position, DistortionLanes* kept, SplitGradient* nodes,
                  std::vector<ElementRange>& stressed);

/// (Pa/m³) Factors from a node's summed gradient to a third of its stress, by local number.
struct NodeFactors {
  double *similar, *distorted;
};

/// Converts the nodes' summed gradients to a third of the nodes' stresses (Pa); `mass` (kg) and
/// `nodes` by local number, `factors` is scratch memory of the same length. Nodes of removed
/// triangles have no mass and no stress.
void stressNodes(InstructionSet set, const Chunk& chunk, const double* mass, NodeFactors factors,
                 SplitGradient* nodes);

/// Adds the elastic forces (N) of the nodes' stresses and the elements' distortions.
void addSmoothedForces(InstructionSet set, const Chunk& chunk, const ElementLanes* lanes,
                       const DistortionLanes* kept, const SplitGradient* nodes, Vec2* force);

}  // namespace yadefrag
