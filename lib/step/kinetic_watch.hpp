#pragma once
// Energy out of the time integration itself: bodies that turn or deform more in a step than central
// differences can follow, though it is below the critical one.
//
// Such bodies soon move with more energy than there is. That alone is no proof (at half a step the
// fastest modes lend some from their strain), but a reason to sum up all energies. Rejected: to sum
// them up from time to time, which costs as much as four steps; the kinetic energy costs a
// thirtieth.

#include <cstdint>

namespace yadefrag {

class KineticWatch {
 public:
  /// Bodies have come or gone: what there is has to be summed up anew.
  void restart() { dt_ = 0; }
  /// Has `begin` to be called, with what there is now: with another step energies are others, too.
  [[nodiscard]] bool isNew(double dt) const { return dt_ != dt; }
  /// `total` (J): of the ledger, as it stays from now on. `energy` (J): of the bodies.
  void begin(double dt, double total, double energy);
  /// In which steps to look.
  [[nodiscard]] static bool isDue(std::uint64_t step);
  /// Do the bodies move with more than there is, more than when last asked. `spent` (J): what they
  /// have lost since the ledger began, on balance.
  bool isSuspicious(double kinetic, double spent);
  /// (J) What the bodies have too much, of their kinetic and strain energy; 0 where it is
  /// tolerable, no more than `noise`, or less than twice what was last told.
  [[nodiscard]] double excess(double energy, double spent, double noise) const;
  /// The same, of their largest energy so far, now told.
  double tell(double excess);

 private:
  double dt_ = 0;      // s; 0: not begun
  double total_ = 0;   // J
  double most_ = 0;    // J
  double looked_ = 0;  // J
  double told_ = 0;    // of most_; 0: never
};

}  // namespace yadefrag
