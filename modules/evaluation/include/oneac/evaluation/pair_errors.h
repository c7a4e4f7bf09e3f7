#pragma once

#include "oneac/evaluation/relative_poses_io.h"
#include "oneac/evaluation/statistics.h"
#include "oneac/geometry/relative_pose.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace oneac {

/// A true step below it says nothing about direction or length [m].
inline constexpr double kSmallestTrueStep = 0.1;
/// A pair beyond either is in a wrong basin, not merely inaccurate: 1° and 15° [rad].
inline constexpr double kBadRotation = 0.017453292519943295;
inline constexpr double kBadDirection = 0.2617993877991494;

/// How far one relative pose is from the truth.
struct PairError {
  std::size_t index1 = 0;
  std::size_t index2 = 0;
  double true_step = 0.0;           ///< |t| of the reference [m]
  double rotation = 0.0;            ///< ξ_R [rad]
  std::optional<double> direction;  ///< ξ_t [rad]; empty for a small true step or a zero t
  std::optional<double> length;     ///< |t_est| / |t_ref| − 1; only with a direction and metric

  /// The true step exceeds 0.1 m: its direction can be judged.
  [[nodiscard]] bool is_moving() const { return true_step > kSmallestTrueStep; }
  /// Wrong basin. Never where the direction cannot be judged.
  [[nodiscard]] bool is_bad() const;
};

/// All pairs together. A statistic is empty when no pair contributes.
struct PairSummary {
  std::size_t pairs = 0;              ///< with a reference
  std::size_t without_reference = 0;  ///< left out
  std::size_t moving = 0;             ///< true step above kSmallestTrueStep
  std::size_t metric = 0;             ///< moving pairs with a length error
  std::size_t bad = 0;
  std::optional<Statistics> rotation;   ///< [rad]
  std::optional<Statistics> direction;  ///< [rad], moving pairs with an estimated direction
  std::optional<Statistics> length;     ///< absolute value of the length error [-]
};

/// @param row    the estimate
/// @param truth  T_2_1 of the reference in metres, in the same camera frame
[[nodiscard]] PairError pair_error(const RelativePoseRow& row, const RelativePose& truth);

/// Of all pairs with a reference; those without are only counted.
[[nodiscard]] PairSummary summarise(const std::vector<PairError>& errors,
                                    std::size_t without_reference);

}  // namespace oneac
