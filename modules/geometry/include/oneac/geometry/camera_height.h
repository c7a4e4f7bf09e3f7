#pragma once

namespace oneac {

/// What the height of a vehicle's camera above the road can be: from a sports car's bumper to the
/// roof of a lorry or bus. A height in centimetres is none.
struct CameraHeight {
  static constexpr double kLowest = 0.3;   ///< [m]
  static constexpr double kHighest = 5.0;  ///< [m]

  [[nodiscard]] static bool is_plausible(double height) {
    return height >= kLowest && height <= kHighest;
  }
};

}  // namespace oneac
