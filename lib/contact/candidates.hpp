#pragma once
// Slaves and masters that may touch before the next search, and the side on which the slave is
// (paper §3.2, §5.1).

#include <cstdint>
#include <span>
#include <vector>

#include "core/footprint.hpp"
#include "core/ids.hpp"
#include "core/vec2.hpp"
#include "surface/contact_surface.hpp"

namespace yadefrag {

/// Rows by slave: the masters of one slave are adjacent, and rules for adjacent pieces decide
/// together which of them is active.
struct Candidates {
  std::vector<EntryId> slaves;         ///< slaves with candidates, ascending
  std::vector<std::uint32_t> offsets;  ///< row r: [offsets[r], offsets[r + 1])
  std::vector<EntryId> masters;        ///< ascending within a row
  /// True if the slave was on the void side of the master (paper fig. 8) at the end of the last
  /// step. Empty if entry is by the path.
  std::vector<std::uint8_t> outside;
  /// By row: distance (m) that the fastest node must travel before the row can have an active
  /// (LocalSearch::scan); empty: unknown. Derived data.
  std::vector<double> idleDistance;

  [[nodiscard]] std::size_t size() const { return masters.size(); }
  void clear();
  void addTo(Footprint& footprint) const {
    footprint.add(Use::kSearch, slaves, offsets, masters, outside, idleDistance);
  }
};

/// A slave and a master in whose halo it is.
struct SlaveMaster {
  EntryId slave;
  EntryId master;
  friend auto operator<=>(const SlaveMaster&, const SlaveMaster&) = default;
};

/// Sorts the pairs into rows. Outside flags, if used, are kept for pairs that `candidates` had
/// already; those of new pairs are determined from `before`, the positions at the end of the last
/// step (m, by node). Returns the former `candidates`.
Candidates replaceCandidates(Candidates& candidates, std::vector<SlaveMaster>& pairs,
                             const ContactSurfaces& surfaces, std::span<const Vec2> before,
                             bool flags = true);

/// The same, in addition to the existing candidates.
void addCandidates(Candidates& candidates, std::vector<SlaveMaster>& pairs,
                   const ContactSurfaces& surfaces, std::span<const Vec2> before,
                   bool flags = true);

/// Sets flags for all pairs, from `before` where there are none yet, or removes all flags.
void keepFlags(Candidates& candidates, const ContactSurfaces& surfaces,
               std::span<const Vec2> before, bool keep);

/// Removes pairs with a removed piece.
void removeGone(Candidates& candidates, const ContactSurfaces& surfaces);

}  // namespace yadefrag
