#pragma once
// Contact, cracks and the time integration can only reduce the energy of bodies, and contact
// prevents overlaps. If they create energy, or if bodies penetrate each other, a message is given,
// and again for every doubling.
//
// All limits are in joules: a message about a small energy of bodies at rest does not suppress a
// message about a larger one after they have started to move.

#include <cstdint>
#include <string>

#include "time/energy_ledger.hpp"

namespace yadefrag {

/// Input of the check after a step.
struct WatchedStep {
  std::uint64_t step;
  double time;      ///< s
  double dt;        ///< s
  double depth;     ///< m, deepest remaining penetration
  double shortest;  ///< m, shortest segment
  double halo;      ///< m, a smooth master loses deeper contacts
  const EnergyLedger& ledger;
};

/// All members are part of the saved state: a loaded run gives the same messages.
class EnergyWatch {
 public:
  /// Starts the balance: the bodies have `energy` (J) at present.
  void begin(double energy, const EnergyLedger& ledger);
  /// A body with `energy` (J) was added.
  void join(double energy) { expected += energy; }
  /// Must be called after every step, before all other functions.
  void count(const WatchedStep& step);

  /// True if contact or cracks may have created more energy than tolerated.
  bool mayHaveCreated(const WatchedStep& step);
  /// The message; empty if there is none. `noise` (J): energy of rounding errors.
  std::string contactMessage(const WatchedStep& step, double noise);

  /// True if the kinetic energy, or all energies, must be evaluated in this step.
  [[nodiscard]] static bool isDue(std::uint64_t step);
  /// A change of the step's length has added `energy` (J) to the sum of kinetic and strain energy.
  void addOfChange(double energy) { ofChanges += energy; }
  /// True if the bodies may have more energy than supplied. A kinetic energy above that is no
  /// proof, since at the half step the highest modes temporarily have energy of their strain; it is
  /// a reason to compute the strain energy, and so is the energy that changes of the step have
  /// added since it was last computed.
  bool mayHaveGrown(const WatchedStep& step, double kinetic);
  /// The message for the kinetic plus strain energy (J).
  std::string growthMessage(const WatchedStep& step, double energy, double noise);

  std::string depthMessage(const WatchedStep& step);

  /// True if overlaps that single passing cannot detect must be checked in this step.
  [[nodiscard]] static bool isOverlapDue(std::uint64_t step);
  /// The message about an overlap of triangles (m) that is not at a point in contact.
  std::string overlapMessage(const WatchedStep& step, double overlap);

  /// True if `spinMessage` needs the present sum of spins.
  [[nodiscard]] bool mayHaveSpun(const WatchedStep& step) const;
  /// The message about created angular momentum; `sum` (kg m²/s): as of sumOfSpins.
  std::string spinMessage(const WatchedStep& step, double sum);

  double expected = 0;    ///< J, expected total of the ledger
  double gone = 0;        ///< J, part of the supplied energy that left with removed bodies
  double most = 0;        ///< J, the largest energy that the bodies could have
  double dissipated = 0;  ///< J, largest contact + friction in the ledger: a decrease is created
  double contact = 0, friction = 0;  ///< J, the largest of each
  double split = 0;  ///< J, part of the ledger's fracture: separated averages of strains
  double evaluatedCreated = 0, evaluatedGrown = 0;  ///< J, at the last evaluation
  double reportedCreated = 0, reportedGrown = 0,
         reportedDepth = 0;  ///< J, J, m, in the last message; 0: none
  double mostSpin = 0;       ///< kg m²/s, largest sum of spins that was evaluated
  double reportedSpin = 0;   ///< kg m²/s, in the last message; 0: none
  /// J, growth at the last sum over all energies, and the sum of `addOfChange` since then.
  double knownGrowth = 0, ofChanges = 0;
  double lastStep = 0, leastStep = 0, mostStep = 0;  ///< s; 0: none so far
  std::uint64_t changes = 0;  ///< number of steps with another length than the previous one

 private:
  [[nodiscard]] double created(const EnergyLedger& ledger) const;
  [[nodiscard]] double createdByBoth(const EnergyLedger& ledger) const;
  [[nodiscard]] double exchanged(const EnergyLedger& ledger) const;
  [[nodiscard]] double tolerated(double reported) const;
  [[nodiscard]] std::string stepAdvice(const WatchedStep& step) const;
};

}  // namespace yadefrag
