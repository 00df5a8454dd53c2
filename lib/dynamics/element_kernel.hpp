#pragma once
// The loops over a chunk's elements, compiled for several instruction sets and chosen at run time:
// the library runs on any amd64. Every set gives the same bits, since the operations are the same,
// element by element, and none are contracted (lib/CMakeLists.txt).

#include "core/vec2.hpp"
#include "dynamics/element_chunks.hpp"

namespace yadefrag {

/// AVX-512 was no faster (6.5 against 6.1 ns an element on a Zen 5).
enum class InstructionSet { kBaseline, kAvx2 };

/// The widest one that this machine has.
InstructionSet bestInstructionSet();

/// Adds the elastic forces (N) of a chunk to `force`; positions and forces by local node number.
/// `laws`: of the chunk, if it is mixed. Returns false if an element is flat (`kFlat`), inverted or
/// not finite.
bool addElasticForces(InstructionSet set, const Chunk& chunk, const ElementLanes* lanes,
                      const ElementLaws* laws, const Vec2* position, Vec2* force);

/// The same bits; appends also those ranges of up to kLanes elements, ascending, of which at least
/// one is stressed (`Chunk::squaredLook`).
bool addElasticForces(InstructionSet set, const Chunk& chunk, const ElementLanes* lanes,
                      const ElementLaws* laws, const Vec2* position, Vec2* force,
                      std::vector<ElementRange>& stressed);

/// Coefficients of the bulk viscosity: a pressure −ρL(b₁cε̇) + ρ(b₂Lε̇)², ε̇ the rate of the volume
/// strain and L the smallest altitude of the present triangle. The linear part acts in compression
/// and in expansion, so that ringing is damped in both; the quadratic part in compression alone.
struct BulkViscosity {
  double linear = 0;     ///< b₁
  double quadratic = 0;  ///< b₂

  [[nodiscard]] bool isOn() const { return linear != 0 || quadratic != 0; }
  bool operator==(const BulkViscosity&) const = default;
};

/// Adds the forces (N) of the bulk viscosity of a chunk.
void addViscousForces(const BulkViscosity& viscosity, const Chunk& chunk, const ElementLanes* lanes,
                      const ElementLaws* laws, const Vec2* position, const Vec2* velocity,
                      Vec2* force);

}  // namespace yadefrag
