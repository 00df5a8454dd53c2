#pragma once

#include "step/energy_watch.hpp"

namespace yadefrag::test {

/// Step 7 at .5 s, of .1 s, without penetration; the shortest segment 1 m, the halo .5 m.
inline WatchedStep stepOf(const EnergyLedger& ledger) { return {7, .5, .1, 0, 1, .5, ledger}; }

}  // namespace yadefrag::test
