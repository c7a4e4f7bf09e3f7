#pragma once

namespace oneac {

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegree = kPi / 180.0;  ///< [rad]; 5.0 * kDegree are radians, a / kDegree degrees

}  // namespace oneac
