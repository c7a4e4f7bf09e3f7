#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace oneac {

/// A straight stretch of a drive. The road told its way for a height of the camera that somebody
/// assumed, another sensor told it in metres.
struct WaySpan {
  double by_road = 0.0;    ///< [m] if the assumed height is right
  double by_sensor = 0.0;  ///< [m]
  double sigma = 0.0;      ///< [m] 1σ of by_sensor that is its own, above 0
};

/// What ways say of the height.
struct HeightMeasurement {
  double ratio = 1.0;  ///< true height over the assumed one
  double sigma = 0.0;  ///< relative 1σ of it, without what all ways of the sensor share
  double way = 0.0;    ///< [m] by the sensor
  std::size_t spans = 0;
};

/// Lengths by the road are as the height of the camera above it: by_sensor = ratio · by_road.
/// Least squares, from eight spans on with Cauchy's weights; σ is the larger of that of the
/// residuals' scatter and of the one that knows of errors that last [Newey and West 1987], times
/// Student's factor for few spans.
/// @param spans  in order of time
/// @return empty for less than three spans and twenty metres
/// @throws std::invalid_argument unless ways are finite and not negative, and sigma above 0
[[nodiscard]] std::optional<HeightMeasurement> measure_height_by_ways(
    const std::vector<WaySpan>& spans);

/// Several sensors together, each with its σ: the weighted mean.
/// @return empty where there is none, or where two contradict each other by more than 3 σ
/// @throws std::invalid_argument unless every ratio and every sigma is above 0
[[nodiscard]] std::optional<HeightMeasurement> height_by_all(
    const std::vector<HeightMeasurement>& sensors);

}  // namespace oneac
