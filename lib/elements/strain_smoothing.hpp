#pragma once
// Smoothed strains in a step.

#include <span>
#include <vector>

#include "elements/element_kernel.hpp"
#include "elements/node_sums.hpp"
#include "elements/smoothed_law.hpp"

namespace yadefrag {

// --- The loops over the elements of a chunk with smoothed strains. There are two passes: gradients
// to nodes, then stresses from nodes. As in element_kernel.hpp, every instruction set gives the
// same bits.

/// c and d of kLanes elements, stored by the first pass for the second.
struct alignas(64) DistortionLanes {
  double part[2][kLanes];
};

/// Of a chunk's nodes, by local number: sums of gradients, then stresses; with an axis (null
/// otherwise) those of the strain along its circle.
struct SmoothedNodes {
  SplitGradient* gradient;
  double* around;
};

/// Adds the gradients, multiplied by a third of the volume (m³), or by its part by mass, to
/// `nodes`, stores the distortions, and appends the ranges of stressed elements as
/// `addElasticForces` does. Returns false if an element is inverted or not finite.
bool sumGradients(InstructionSet set, const Chunk& chunk, const ElementLanes* lanes,
                  const ElementHoops* hoops, const Vec2* position, DistortionLanes* kept,
                  SmoothedNodes nodes, std::vector<ElementRange>& stressed);

/// (Pa/m³) Factors from a node's summed gradient to a third of its stress, by local number.
struct NodeFactors {
  double *similar, *distorted;
};

/// Converts the nodes' summed gradients to a third of the nodes' stresses (Pa), with an axis to
/// these; `mass` (kg) by local number, `factors` is scratch memory of the same length. Nodes of
/// removed triangles have no mass and no stress.
void stressNodes(InstructionSet set, const Chunk& chunk, const double* mass, NodeFactors factors,
                 SmoothedNodes nodes);

/// Adds the elastic forces (N) of the nodes' stresses and the elements' distortions.
void addSmoothedForces(InstructionSet set, const Chunk& chunk, const ElementLanes* lanes,
                       const ElementHoops* hoops, const DistortionLanes* kept, SmoothedNodes nodes,
                       Vec2* force);

// --- Smoothed strains in a step: between the two passes over the chunks the sums of nodes in
// several chunks are added, in a fixed order. No cost if no body has smoothed strains.

class StrainSmoothing {
 public:
  /// Memory of one thread.
  struct Room {
    std::vector<double> mass, similar, distorted;
    void resize(std::size_t count) {
      mass.resize(count), similar.resize(count), distorted.resize(count);
    }
  };

  void rebuild(const ElementChunks& elements);
  /// Must be called after a split of nodes.
  void follow(const ElementChunks& elements, std::span<const std::uint32_t> abandoned) {
    gradient_.follow(elements, abandoned);
    around_.follow(elements, abandoned);
  }
  [[nodiscard]] bool isOn() const { return !distortion_.empty(); }

  /// First pass, for one chunk; positions by local number. Returns false if an element is flat,
  /// inverted or not finite.
  bool sum(InstructionSet set, const ElementChunks& elements, const Chunk& chunk,
           const Vec2* position, std::vector<ElementRange>& stressed);
  /// After the first pass, for each row of `ElementChunks::sharedNodes`: that node's whole sum.
  void sumShared(const ElementChunks& elements, std::size_t row) {
    gradient_.sumShared(elements, row);
    if (around_.isOn()) around_.sumShared(elements, row);
  }
  /// Second pass, for one chunk; `mass` (kg) by node.
  void addForces(InstructionSet set, const ElementChunks& elements, const Chunk& chunk,
                 const std::vector<double>& mass, Room& room, Vec2* force);

 private:
  NodeSums<SplitGradient> gradient_;  // with a third of the volumes (m³), then stresses (Pa)
  NodeSums<double> around_;           // likewise, with an axis, of the strain along its circle
  std::vector<DistortionLanes> distortion_;
};

}  // namespace yadefrag
