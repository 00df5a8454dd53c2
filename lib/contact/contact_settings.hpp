#pragma once

namespace yadefrag {

enum class Correction {
  kLagrange,  ///< exact non-penetration, forces from a linear system (paper §2)
  kPenalty,   ///< forces in proportion to penetration, for comparison
};

/// Criterion for a slave to become active on a master.
enum class Entry {
  kPath,  ///< its path in the step crosses the moving piece (path_rules.hpp)
  kFlags,  ///< a flag says that it was outside the piece's line (paper §5.1, §5.2; joint_rules.hpp)
};

struct ContactSettings {
  Correction correction = Correction::kLagrange;
  /// 1: of two surfaces the points of the finer one are slaves, and the sharp corners of the other.
  /// 2: every point of both.
  int passes = 1;
  /// Fraction of the stiffness that would remove a penetration in one step.
  double penaltyFactor = .2;
  /// Width of the halo over the shortest segment; 0: determined by the bodies' speed.
  double halo = 0;
  Entry entry = Entry::kPath;
};

}  // namespace yadefrag
