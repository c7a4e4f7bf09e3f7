#include "oneac/evaluation/georeference.h"

#include "oneac/base/median.h"
#include "oneac/base/number_text.h"
#include "oneac/geometry/relative_pose.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

namespace oneac {
namespace {

constexpr std::size_t kFewest = 5;
constexpr double kLongestGap_s = 2.0;  // between frames around a fix
constexpr double kLeastSpread = 10.0;  // [m] a receiver wanders by two metres in minutes: 11°
constexpr double kWander = 2.0;        // [m] of it, which neighbouring fixes share
constexpr double kLeastShare = 5.0;    // the drive's spread in units of the fixes' scatter
constexpr double kOfMedian = 1.2;      // root mean square of a plane normal distance, in medians
constexpr int kRounds = 20;

struct Pair {
  Eigen::Vector3d drive, enu;
};

std::optional<Eigen::Vector3d> position_at(const Trajectory& drive, double time) {
  const auto next = std::upper_bound(drive.times.begin(), drive.times.end(), time);
  if (next == drive.times.begin() || next == drive.times.end()) return std::nullopt;
  const auto i = static_cast<std::size_t>(std::distance(drive.times.begin(), next));
  const double gap = drive.times[i] - drive.times[i - 1];
  if (gap > kLongestGap_s) return std::nullopt;
  const Eigen::Vector3d a = drive.poses[i - 1].translation(), b = drive.poses[i].translation();
  return a + (b - a) * ((time - drive.times[i - 1]) / gap);
}

std::vector<Pair> pairs_of(const Trajectory& drive, const std::vector<PositionFix>& fixes) {
  std::vector<Pair> pairs;
  for (const PositionFix& fix : fixes) {
    if (const auto position = position_at(drive, fix.time_s)) pairs.push_back({*position, fix.enu});
  }
  return pairs;
}

struct Centres {
  Eigen::Vector3d drive = Eigen::Vector3d::Zero(), enu = Eigen::Vector3d::Zero();
};

Centres centres_of(const std::vector<Pair>& pairs, const std::vector<double>& weights) {
  Centres centres;
  double sum = 0.0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    centres.drive += weights[i] * pairs[i].drive;
    centres.enu += weights[i] * pairs[i].enu;
    sum += weights[i];
  }
  return {centres.drive / sum, centres.enu / sum};
}

/// Weighted least squares: the turn about the vertical, scale and shift.
Similarity fit(const std::vector<Pair>& pairs, const std::vector<double>& weights, bool metric) {
  const Centres centres = centres_of(pairs, weights);
  double along = 0.0, across = 0.0, square = 0.0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Eigen::Vector3d p = pairs[i].drive - centres.drive, q = pairs[i].enu - centres.enu;
    along += weights[i] * (p.x() * q.x() + p.y() * q.y());
    across += weights[i] * (p.x() * q.y() - p.y() * q.x());
    square += weights[i] * p.head<2>().squaredNorm();
  }
  Similarity found;
  if (square > 0.0 && !metric) found.scale = std::hypot(along, across) / square;
  found.R =
      Eigen::AngleAxisd(std::atan2(across, along), Eigen::Vector3d::UnitZ()).toRotationMatrix();
  found.t = centres.enu - found.scale * (found.R * centres.drive);
  return found;
}

std::vector<double> residuals_of(const std::vector<Pair>& pairs, const Similarity& enu_drive) {
  std::vector<double> residuals;
  for (const Pair& pair : pairs) {
    residuals.push_back((pair.enu - enu_drive * pair.drive).head<2>().norm());
  }
  return residuals;
}

/// Huber's weights: a fix beyond two medians pulls no harder than one there.
std::vector<double> weights_of(const std::vector<double>& residuals) {
  constexpr double kLeast = 0.1;  // [m] no receiver is better
  const double bound = std::max(kLeast, 2.0 * upper_median(residuals));
  std::vector<double> weights;
  for (const double residual : residuals) {
    weights.push_back(residual > bound ? bound / residual : 1.0);
  }
  return weights;
}

double root_mean_square(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

/// [m] root mean square distance from their centre, of the fixes or of the drive: the lesser, so
/// that wild fixes are no way.
double spread_of(const std::vector<Pair>& pairs, double scale) {
  const Centres centres = centres_of(pairs, std::vector<double>(pairs.size(), 1.0));
  std::vector<double> fixes, drive;
  for (const Pair& pair : pairs) {
    fixes.push_back((pair.enu - centres.enu).head<2>().norm());
    drive.push_back(scale * (pair.drive - centres.drive).head<2>().norm());
  }
  return std::min(root_mean_square(fixes), root_mean_square(drive));
}

/// [m] A receiver's height is off by tens of metres now and then, whatever its place.
double height_of(const std::vector<Pair>& pairs, double scale) {
  std::vector<double> heights;
  for (const Pair& pair : pairs) heights.push_back(pair.enu.z() - scale * pair.drive.z());
  return upper_median(std::move(heights));
}

GeoreferenceResult none(const std::string& reason) {
  return {false, {}, reason};
}

/// What the fit amounts to, or why it is none.
GeoreferenceResult judged(const std::vector<Pair>& pairs, const Similarity& enu_drive) {
  const std::vector<double> residuals = residuals_of(pairs, enu_drive);
  const double rms = root_mean_square(residuals), spread = spread_of(pairs, enu_drive.scale);
  const double middle = upper_median(residuals);
  const double scatter = kOfMedian * middle;
  if (!(spread >= kLeastSpread)) {
    return none("drive or GPS positions scatter by " + fixed_text(spread, 1) +
                " m about their middle (a straight way by 0.29 of its length), 10 m are needed");
  }
  if (!(spread >= kLeastShare * scatter) || !(enu_drive.scale > 0.0)) {
    return none("the GPS positions do not follow the drive: " + fixed_text(scatter, 1) +
                " m apart where the drive covers " + fixed_text(spread, 1) + " m");
  }
  const double yaw_sigma = std::max(scatter, kWander) / spread;
  return {true,
          {enu_drive, pairs.size(), rms, middle,
           *std::max_element(residuals.begin(), residuals.end()), yaw_sigma},
          ""};
}

}  // namespace

GeoreferenceResult georeference(const Trajectory& vehicle, const std::vector<PositionFix>& fixes,
                                bool metric) {
  if (fixes.empty()) return none("the log holds no GPS position");
  const std::vector<Pair> pairs = pairs_of(vehicle, fixes);
  if (pairs.size() < kFewest) {
    return none(std::to_string(pairs.size()) + " GPS positions in the time of the images, " +
                std::to_string(kFewest) + " are needed");
  }
  std::vector<double> weights(pairs.size(), 1.0);
  Similarity enu_drive;
  for (int round = 0; round < kRounds; ++round) {
    enu_drive = fit(pairs, weights, metric);
    weights = weights_of(residuals_of(pairs, enu_drive));
  }
  enu_drive.t.z() = height_of(pairs, enu_drive.scale);
  return judged(pairs, enu_drive);
}

Trajectory in_enu(const Trajectory& vehicle, const Georeference& georeference) {
  Trajectory moved = vehicle;
  for (Eigen::Isometry3d& pose : moved.poses) {
    pose.translation() = georeference.enu_drive * Eigen::Vector3d(pose.translation());
    pose.linear() = georeference.enu_drive.R * pose.linear();
  }
  return moved;
}

}  // namespace oneac
