#pragma once
// Contact, cracks and the time integration can only take energy from bodies, and contact keeps them
// apart. Where they give energy, or bodies sink into one another, a sentence says so, and again for
// every doubling.
//
// All bounds are in joules: a warning about a small energy of bodies at rest does not hide a larger
// one once they move.

#include <cstdint>
#include <string>

#include "dynamics/energy_ledger.hpp"

namespace yadefrag {

/// What the watch looks at, after a step.
struct WatchedStep {
  std::uint64_t step;
  double time;      ///< s
  double dt;        ///< s
  bool isPenalty;   ///< contact stores energy, and gives it back
  double depth;     ///< m, deepest penetration that was left
  double shortest;  ///< m, shortest segment
  double halo;      ///< m, a smooth master loses what is deeper
  const EnergyLedger& ledger;
};

/// All members are state: a run that goes on from a saved one says the same.
class EnergyWatch {
 public:
  /// Bodies have `energy` (J) now, whatever was before.
  void begin(double energy, const EnergyLedger& ledger);
  /// A body with `energy` (J) has come.
  void join(double energy) { expected += energy; }
  /// After every step, before all that follows.
  void count(const WatchedStep& step);

  /// Does contact, or do cracks, seem to have given more than they may.
  bool mayHaveCreated(const WatchedStep& step);
  /// The sentence; empty if there is none to say. `noise` (J): what rounding makes.
  std::string complainOfContact(const WatchedStep& step, double noise);

  /// Is this a step to look at the kinetic energy, or at all energies?
  [[nodiscard]] static bool isDue(std::uint64_t step);
  /// Do the bodies seem to have more than there is. That they move with more proves nothing, for at
  /// half a step the fastest modes lend some from their strain, but is a reason to sum up strain.
  bool mayHaveGrown(const WatchedStep& step, double kinetic);
  /// The same, of their kinetic and strain energy (J).
  std::string complainOfGrowth(const WatchedStep& step, double energy, double noise);

  std::string complainOfDepth(const WatchedStep& step);

  double expected = 0;               ///< J, what the ledger's total should be
  double gone = 0;                   ///< J, of what came in: what bodies that left took along
  double most = 0;                   ///< J, the largest energy that the bodies could have
  double contact = 0, friction = 0;  ///< J, of the ledger: what they gave is what it is below these
  double split = 0;                  ///< J, of the ledger's fracture: strains no longer averaged
  double lookedCreated = 0, lookedGrown = 0;             ///< J, when last looked at
  double toldCreated = 0, toldGrown = 0, toldDepth = 0;  ///< J, J, m; 0: never
  double lastStep = 0, leastStep = 0, mostStep = 0;      ///< s; 0: none so far
  std::uint64_t changes = 0;                             ///< steps of another length than the last

 private:
  [[nodiscard]] double created(const EnergyLedger& ledger) const;
  [[nodiscard]] double tolerated(double told) const;
  [[nodiscard]] std::string stepAdvice(const WatchedStep& step) const;
};

}  // namespace yadefrag
