#pragma once
// Slaves and masters that may touch before the next search (paper §3.2).

#include <cstdint>
#include <span>
#include <vector>

#include "core/ids.hpp"
#include "surface/contact_surface.hpp"

namespace yadefrag {

/// Rows by slave. A search makes them anew. A crack appends rows: the last row of a slave replaces
/// the former ones, so that a crack costs what is near it, not what is near anywhere.
struct Candidates {
  std::vector<EntryId> slaves;         ///< slaves with candidates
  std::vector<std::uint32_t> offsets;  ///< row r: [offsets[r], offsets[r + 1])
  std::vector<EntryId> masters;        ///< ascending within a row

  /// How far a row's slave is from a contact, at the last detection that examined it. Motion keeps
  /// the values valid, as bounds; a change of the row or of its pieces deletes them.
  struct Distance {
    double far;   ///< m, from the pieces and corners that were not near; and
    double open;  ///< m, gap that keeps the near ones without a row
    double when;  ///< m, bound of what each surface node had moved until then
  };
  std::vector<Distance> distances;  ///< by row; empty: unknown
  Distance nearest{};               ///< of all rows

  [[nodiscard]] std::size_t size() const { return masters.size(); }
  void clear() { *this = {}; }

  static constexpr std::uint32_t kNone = 0xffffffff;
  /// After rows were added or loaded, for the functions below. `entries`: of the surfaces.
  void index(std::size_t entries = 0);
  /// The rows in force, by slave, ascending: results do not depend on when a search was done.
  [[nodiscard]] const std::vector<std::uint32_t>& rows() const { return rows_; }
  /// The row of a slave, or kNone.
  [[nodiscard]] std::uint32_t rowOf(EntryId slave) const { return rowOf_[slave.value]; }
  [[nodiscard]] std::span<const EntryId> mastersOfRow(std::size_t row) const {
    return {masters.data() + offsets[row], masters.data() + offsets[row + 1]};
  }
  /// Empty without a row.
  [[nodiscard]] std::span<const EntryId> mastersOf(EntryId slave) const {
    const std::uint32_t row = rowOf(slave);
    return row == kNone ? std::span<const EntryId>{} : mastersOfRow(row);
  }
  /// Appends the slaves that have this master.
  void appendSlavesOf(EntryId master, std::vector<EntryId>& found);

 private:
  std::vector<std::uint32_t> rowOf_;  // by entry
  std::vector<std::uint32_t> rows_;
  std::size_t indexed_ = 0;  // number of rows in `rowOf_`
  // By entry as a master: one of its places in `masters`; by place: another one.
  std::vector<std::uint32_t> placeOf_, nextPlace_;
};

/// A slave and a master in whose halo it is.
struct SlaveMaster {
  EntryId slave;
  EntryId master;
  friend auto operator<=>(const SlaveMaster&, const SlaveMaster&) = default;
};

/// Sorts the pairs into rows, ascending, and indexes them. Returns the former `candidates`.
/// `entries`: of the surfaces.
Candidates replaceCandidates(Candidates& candidates, std::vector<SlaveMaster>& pairs,
                             std::size_t entries);

/// Adds pairs to indexed candidates after the pieces of the entries `around` have changed: these
/// include all slaves of the pairs, and all slaves with a master among them.
void addCandidates(Candidates& candidates, std::vector<SlaveMaster>& pairs,
                   std::span<const EntryId> around);

/// Removes pairs with a removed piece from indexed candidates.
void removeGone(Candidates& candidates, const ContactSurfaces& surfaces);

// --- The pairs of a step that have a row, by slave.

/// Data of a row with a force that are stored for the next step.
struct StoredContact {
  SlaveMaster pair;
  double normalForce, tangentForce;  ///< N, start values of the next solution
  double toleratedGap;               ///< m, ≤ 0: the overlap that the row has left
};

/// A list of pairs with chains by slave. Nothing is cleared by entry: an index in `first_` is valid
/// if the pair there has that slave.
class PairsOfSlaves {
 public:
  void clear() { links_.clear(); }
  /// Makes room for slaves below this number.
  void grow(std::size_t entries) {
    if (first_.size() < entries) first_.resize(entries, 0);
  }
  /// The number of a pair is that of pairs added before.
  void add(SlaveMaster pair) {
    const std::uint32_t next = firstOf(pair.slave);
    first_[pair.slave.value] = static_cast<std::uint32_t>(links_.size());
    links_.push_back({pair, next});
  }
  /// The number of a pair, or kNone.
  [[nodiscard]] std::uint32_t numberOf(SlaveMaster pair) const {
    std::uint32_t at = firstOf(pair.slave);
    while (at != kNone && links_[at].pair.master != pair.master) at = links_[at].next;
    return at;
  }
  static constexpr std::uint32_t kNone = 0xffffffff;

 private:
  struct Link {
    SlaveMaster pair;
    std::uint32_t next;  // of the same slave
  };
  [[nodiscard]] std::uint32_t firstOf(EntryId slave) const {
    if (slave.value >= first_.size()) return kNone;
    const std::uint32_t at = first_[slave.value];
    return at < links_.size() && links_[at].pair.slave == slave ? at : kNone;
  }

  std::vector<Link> links_;
  std::vector<std::uint32_t> first_;  // by slave: its last link
};

}  // namespace yadefrag
