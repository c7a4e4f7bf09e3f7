#include "window_adjustment.h"

#include "window_costs.h"

#include "oneac/base/median.h"
#include "oneac/geometry/triangulation.h"

#include <ceres/loss_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <utility>

namespace oneac {
namespace {

// [views] a track of fewer tells nothing that its landmark does not absorb.
constexpr std::size_t kFewestSightings = 3;
// [rad] of parallax below which a landmark starts far away, and where that is [lengths of the way].
constexpr double kLeastParallax = 1e-4, kFar = 1e3;
// [way⁻¹] the start of a landmark behind the camera, or too near.
constexpr double kNearest = 20.0;

double way_of(const CalibrationWindow& window) {
  const Eigen::Vector3d first = window.views.front().T_view_map.inverse().t;
  return std::max((window.views.back().T_view_map.inverse().t - first).norm(), 1e-9);
}

ceres::Solver::Options solver_options(int max_iterations, double function_tolerance) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_SCHUR;
  options.max_num_iterations = max_iterations;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  options.function_tolerance = function_tolerance;
  return options;
}

ceres::Problem::Options borrowing_loss() {
  ceres::Problem::Options options;
  options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  return options;
}

}  // namespace

WindowAdjustment::WindowAdjustment(const CalibrationWindow& window, const PinholeCamera& from,
                                   const IntrinsicsVector& start, const MeasurementOptions& options)
    : window_(window), from_(from), options_(options), change_(start) {
  poses_.assign(window.views.size(), Pose{});
  std::map<std::uint64_t, Track> tracks;
  for (std::size_t i = 0; i < window.views.size(); ++i) {
    for (const CalibrationSighting& s : window.views[i].sightings) {
      tracks[s.track].emplace_back(i, s.u);
    }
  }
  std::vector<const Track*> chosen;
  for (const auto& [id, track] : tracks) {
    if (track.size() >= kFewestSightings) chosen.push_back(&track);
  }
  std::stable_sort(chosen.begin(), chosen.end(),
                   [](const Track* a, const Track* b) { return a->size() > b->size(); });
  if (chosen.size() > options.most_tracks) chosen.resize(options.most_tracks);
  const PinholeCamera camera = changed(from, start);
  for (const Track* track : chosen) add_track(*track, camera);
}

void WindowAdjustment::add_track(const Track& track, const PinholeCamera& camera) {
  const std::size_t anchor = track.front().first;
  const RelativePose& T_anchor_map = window_.views[anchor].T_view_map;
  const RelativePose T = window_.views[track.back().first].T_view_map * T_anchor_map.inverse();
  const Eigen::Vector2d ray = normalise_distorted(camera, track.front().second);
  const Eigen::Vector2d last = normalise_distorted(camera, track.back().second);
  if (!ray.allFinite() || !last.allFinite()) return;
  const double way = way_of(window_);
  double rho = 1.0 / (kFar * way);
  const auto point = triangulate(T, ray, last, kLeastParallax);
  if (point && point->in_front()) rho = std::min(1.0 / point->z1, kNearest / way);
  for (const auto& [view, u] : track) {
    const RelativePose T_view = window_.views[view].T_view_map * T_anchor_map.inverse();
    if (!((T_view.R * ray.homogeneous() + rho * T_view.t).z() > 0.1)) return;
  }
  for (const auto& [view, u] : track) seen_.push_back({view, landmarks_.size(), u});
  landmarks_.push_back({ray.x(), ray.y(), rho});
  anchors_.push_back(anchor);
}

bool WindowAdjustment::solve(const IntrinsicsMatrix& prior, double sigma_px,
                             double function_tolerance) {
  ceres::CauchyLoss loss(options_.loss_sigmas);
  ceres::Problem problem(borrowing_loss());
  auto ordering = std::make_shared<ceres::ParameterBlockOrdering>();
  for (const Seen& s : seen_) {
    auto* cost = reprojection_cost(from_, window_.views[s.view].T_view_map,
                                   window_.views[anchors_[s.landmark]].T_view_map, s.u, sigma_px);
    problem.AddResidualBlock(cost, &loss, change_.data(), poses_[s.view].data(),
                             landmarks_[s.landmark].data());
  }
  for (Point& point : landmarks_) ordering->AddElementToGroup(point.data(), 0);
  for (Pose& pose : poses_) {
    problem.AddParameterBlock(pose.data(), 6);
    ordering->AddElementToGroup(pose.data(), 1);
  }
  problem.AddParameterBlock(change_.data(), kIntrinsics);
  ordering->AddElementToGroup(change_.data(), 1);
  problem.SetParameterBlockConstant(poses_.front().data());
  problem.AddResidualBlock(
      length_cost(window_.views.front().T_view_map, window_.views.back().T_view_map), nullptr,
      poses_.back().data());
  problem.AddResidualBlock(prior_cost(prior), nullptr, change_.data());
  ceres::Solver::Options options = solver_options(options_.max_iterations, function_tolerance);
  options.linear_solver_ordering = ordering;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return summary.IsSolutionUsable() && change_.allFinite();
}

std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> WindowAdjustment::residuals() const {
  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> all;
  all.reserve(seen_.size());
  for (const Seen& s : seen_) {
    const std::unique_ptr<ceres::CostFunction> cost(
        reprojection_cost(from_, window_.views[s.view].T_view_map,
                          window_.views[anchors_[s.landmark]].T_view_map, s.u, 1.0));
    const double* blocks[] = {change_.data(), poses_[s.view].data(), landmarks_[s.landmark].data()};
    Eigen::Vector2d r;
    if (cost->Evaluate(blocks, r.data(), nullptr)) all.emplace_back(s.u, r);
  }
  return all;
}

double WindowAdjustment::noise_px() const {
  std::vector<double> sizes;
  for (const auto& [u, r] : residuals()) {
    sizes.push_back(std::abs(r.x()));
    sizes.push_back(std::abs(r.y()));
  }
  if (sizes.empty()) return 0.0;
  constexpr double kGaussian = 1.4826;  // 1σ over the median of absolute values
  // Degrees of freedom: poses and landmarks have fitted a part of the noise away.
  const double count = 2.0 * static_cast<double>(seen_.size());
  const double fitted = static_cast<double>(3 * landmarks_.size() + 6 * poses_.size());
  return kGaussian * upper_median(std::move(sizes)) *
         std::sqrt(count / std::max(count - fitted, 1.0));
}

}  // namespace oneac
