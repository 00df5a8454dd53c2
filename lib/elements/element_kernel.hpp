#pragma once
// The loops over a chunk's elements, compiled for several instruction sets, of which one is chosen
// at run time: the library runs on any amd64 processor. Every instruction set gives the same bits,
// since the operations on each element are the same, and the compiler must not contract them
// (lib/CMakeLists.txt). Rejected: AVX-512, which takes as long (6.5 against 6.1 ns per element on a
// Zen 5).

#include "core/lanes.hpp"
#include "core/vec2.hpp"
#include "elements/element_chunks.hpp"

namespace yadefrag {

/// Adds the elastic forces (N) of a chunk to `force`; positions and forces by local node number.
/// `laws`: laws of the chunk, if it is mixed; `hoops`: null in a plane scene. Appends to
/// `stressed`, in ascending order, the ranges of up to kLanes elements of which at least one is
/// stressed (`Chunk::squaredStressLimit`). Returns false if an element is flat (`kFlat`), inverted
/// or not finite.
bool addElasticForces(InstructionSet set, const Chunk& chunk, const ElementLanes* lanes,
                      const ElementLaws* laws, const ElementHoops* hoops, const Vec2* position,
                      Vec2* force, std::vector<ElementRange>& stressed);

/// Coefficients of the bulk viscosity, a pressure −ρL(b₁cε̇) + ρ(b₂Lε̇)², where ε̇ is the rate of
/// the volume strain and L the smallest altitude of the present triangle. The linear part acts in
/// compression and in expansion, so that it damps oscillations in both; the quadratic part acts in
/// compression only.
struct BulkViscosity {
  double linear = 0;     ///< b₁
  double quadratic = 0;  ///< b₂

  [[nodiscard]] bool isOn() const { return linear != 0 || quadratic != 0; }
  bool operator==(const BulkViscosity&) const = default;
};

/// Adds the forces (N) of the bulk viscosity of a chunk.
void addViscousForces(const BulkViscosity& viscosity, const Chunk& chunk, const ElementLanes* lanes,
                      const ElementLaws* laws, bool axisymmetric, const Vec2* position,
                      const Vec2* velocity, Vec2* force);

}  // namespace yadefrag
