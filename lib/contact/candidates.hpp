#pragma once
// Slaves and masters that may touch before the next search (paper §3.2).

#include <cstdint>
#include <vector>

#include "core/ids.hpp"
#include "surface/contact_surface.hpp"

namespace yadefrag {

/// Rows by slave.
struct Candidates {
  std::vector<EntryId> slaves;         ///< slaves with candidates, ascending
  std::vector<std::uint32_t> offsets;  ///< row r: [offsets[r], offsets[r + 1])
  std::vector<EntryId> masters;        ///< ascending within a row

  /// How far a row's slave is from a contact, at the last detection that examined it. Motion keeps
  /// the values valid, as bounds; any change of the candidates deletes them.
  struct Distance {
    double far;   ///< m, from the pieces and corners that were not near; and
    double open;  ///< m, gap that keeps the near ones without a row
    double when;  ///< m, bound of what each surface node had moved until then
  };
  std::vector<Distance> distances;  ///< by row; empty: unknown
  Distance nearest{};               ///< of all rows

  [[nodiscard]] std::size_t size() const { return masters.size(); }
  void clear();
};

/// A slave and a master in whose halo it is.
struct SlaveMaster {
  EntryId slave;
  EntryId master;
  friend auto operator<=>(const SlaveMaster&, const SlaveMaster&) = default;
};

/// Sorts the pairs into rows. Returns the former `candidates`.
Candidates replaceCandidates(Candidates& candidates, std::vector<SlaveMaster>& pairs);

/// The same, in addition to the existing candidates.
void addCandidates(Candidates& candidates, std::vector<SlaveMaster>& pairs);

/// Removes pairs with a removed piece.
void removeGone(Candidates& candidates, const ContactSurfaces& surfaces);

}  // namespace yadefrag
