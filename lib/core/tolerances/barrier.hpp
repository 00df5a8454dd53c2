#pragma once
// Tolerances of the barrier against the collapse of elements, each with its unit and its reason.

namespace yadefrag::tolerance {

/// (of ω²) Margin of the critical step for an element in the barrier, whose stiffness grows within
/// a step. With 1, 4, 9, 16 a column that hits a wall at 1.5 of the wave speed gains 4, 1.2, .3, .2
/// % of its energy.
inline constexpr double kBarrierGrowth = 9;

/// (ratio) The step that is advised for a collapsing element, of the critical one: the element gets
/// flatter still.
inline constexpr double kBarrierAdvised = .5;

}  // namespace yadefrag::tolerance
