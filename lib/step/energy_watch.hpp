#pragma once
// Contact and cracks can only take energy from bodies. Where they give some, or bodies sink into
// one another, a sentence says so, and again for every doubling.

#include <cstdint>
#include <string>

#include "dynamics/energy_ledger.hpp"

namespace yadefrag {

/// What the watch looks at, after a step.
struct WatchedStep {
  std::uint64_t step;
  double time;      ///< s
  bool isPenalty;   ///< contact stores energy, and gives it back
  double depth;     ///< m, deepest penetration that was left
  double shortest;  ///< m, shortest segment
  double halo;      ///< m, a smooth master loses what is deeper
  const EnergyLedger& ledger;
};

class EnergyWatch {
 public:
  /// To be asked in every step: are all bodies' energies worth a look.
  bool isSuspicious(const WatchedStep& step);
  /// The sentence, of the present kinetic and strain energy (J); empty if there is none to say.
  /// `noise` (J) is what rounding of the coordinates makes.
  std::string complain(const WatchedStep& step, double kinetic, double strain, double noise);
  /// The sentence about bodies that are too deep in one another; empty if there is none to say.
  std::string complainOfDepth(const WatchedStep& step);
  /// After a body is gone, and its energy with it.
  void forget(const EnergyLedger& ledger);

  // --- state
  double contact = 0, friction = 0;  ///< J, of the ledger: what they gave is what it is below these
  double most = 0;                   ///< J, the bodies' largest energy of those looked at
  double looked = 0;                 ///< J, given when last looked at
  double told = 0;                   ///< of `most`: given when last told; 0: never
  double toldDepth = 0;              ///< m; 0: never

 private:
  [[nodiscard]] double given(const EnergyLedger& ledger) const;
  [[nodiscard]] double tolerated() const;
};

}  // namespace yadefrag
