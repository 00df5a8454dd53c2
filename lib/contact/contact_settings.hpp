#pragma once

namespace yadefrag {

enum class Correction {
  kLagrange,  ///< non-penetration exactly, forces from a linear system (paper §2)
  kPenalty,   ///< forces in proportion to penetration, for comparison
};

/// How a slave becomes active on a master.
enum class Entry {
  kPath,  ///< its path through the step crosses the moving piece (path_rules.hpp)
  kFlags,  ///< a flag says that it was outside the piece's line (paper §5.1, §5.2; joint_rules.hpp)
};

struct ContactSettings {
  Correction correction = Correction::kLagrange;
  /// 1: of two surfaces the finer one's points are slaves, and the other's sharp corners.
  /// 2: every point of both.
  int passes = 1;
  /// Of the stiffness that would undo a penetration in one step.
  double penaltyFactor = .2;
  /// Width of the halo over the shortest segment; 0: what the bodies' speed asks for.
  double halo = 0;
  Entry entry = Entry::kPath;
};

}  // namespace yadefrag
