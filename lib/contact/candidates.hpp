#pragma once
// Which slaves may come to touch which masters until the next search, and on which side they are
// (paper §3.2, §5.1).

#include <cstdint>
#include <span>
#include <vector>

#include "core/footprint.hpp"
#include "core/ids.hpp"
#include "core/vec2.hpp"
#include "surface/contact_surface.hpp"

namespace yadefrag {

/// Rows by slave: of the masters of one slave, neighbours decide together which is active.
struct Candidates {
  std::vector<EntryId> slaves;         ///< those that have any, ascending
  std::vector<std::uint32_t> offsets;  ///< row r: [offsets[r], offsets[r + 1])
  std::vector<EntryId> masters;        ///< ascending within a row
  /// Was the slave on the void side of the master (paper fig. 8) at the end of the last step. Empty
  /// if entry is by the path.
  std::vector<std::uint8_t> outside;
  /// By row: the way of the fastest node up to which nothing can come of it (LocalSearch::scan);
  /// empty: unknown. Follows from the rest.
  std::vector<double> asleep;

  [[nodiscard]] std::size_t size() const { return masters.size(); }
  void clear();
  void addTo(Footprint& footprint) const {
    footprint.add(Use::kSearch, slaves, offsets, masters, outside, asleep);
  }
};

/// A slave and a master in whose halo it is.
struct SlaveMaster {
  EntryId slave;
  EntryId master;
  friend auto operator<=>(const SlaveMaster&, const SlaveMaster&) = default;
};

/// Sorts the pairs into rows. Outside flags, if there are any, are kept of pairs that `candidates`
/// had already; those of new ones come from `before`, the positions at the end of the last step (m,
/// by node). Returns what `candidates` were.
Candidates replaceCandidates(Candidates& candidates, std::vector<SlaveMaster>& pairs,
                             const ContactSurfaces& surfaces, std::span<const Vec2> before,
                             bool flags = true);

/// The same, but in addition to what is there already.
void addCandidates(Candidates& candidates, std::vector<SlaveMaster>& pairs,
                   const ContactSurfaces& surfaces, std::span<const Vec2> before,
                   bool flags = true);

/// With flags for all pairs, from `before` where there are none yet, or without any.
void keepFlags(Candidates& candidates, const ContactSurfaces& surfaces,
               std::span<const Vec2> before, bool keep);

/// Leaves out those in which a piece takes part that is gone.
void removeGone(Candidates& candidates, const ContactSurfaces& surfaces);

}  // namespace yadefrag
