#pragma once

namespace oneac {

/// cos 25°, of a levelled direction of travel against the axis: beyond it the car manoeuvres, and
/// the elevation of travel mixes with roll.
inline constexpr double kMainlyForward = 0.9;

}  // namespace oneac
