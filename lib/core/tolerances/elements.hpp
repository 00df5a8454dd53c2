#pragma once
// Thresholds of messages about elements, each with its unit and its reason.

namespace yadefrag::tolerance {

/// (smaller principal stretch) An element that is inverted from below this has collapsed over many
/// steps: its law has no limit of compression, and resists with less than 2μ + λ however flat it
/// is. From above this, or by a larger change in one step, it was inverted by the step.
inline constexpr double kCollapsed = .5;

}  // namespace yadefrag::tolerance
