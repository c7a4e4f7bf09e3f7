#include "oneac/loops/global_adjustment.h"

#include "drive_patches.h"
#include "graph_edges.h"

#include "oneac/base/check_bounds.h"
#include "oneac/base/require.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <utility>

namespace oneac {

void GlobalOptions::validate() const {
  check_bounds("global_ba", *this);
}

namespace {

using namespace internal;

// Neighbouring patches share their errors, so that a hundred of them count as a quarter as many:
// the factor of the drive's steps, see frontend's step_covariance.
constexpr double kShared = 4.0;
constexpr double kGate = 13.82;             // χ² of two degrees of freedom, 99.9 %
constexpr double kBehind = 1e-3;            // [-] of the anchor's depth: no image of it
constexpr std::size_t kFewestPatches = 10;  // of a keyframe: six unknowns three times over
constexpr std::size_t kEnoughShared = 10;   // of a loop: the same
constexpr double kWorse = 1.01;  // of the residual: what the metres of the odometry may cost
// Of the trust region: a patch that was seen twice from one place has no depth, and its equations
// no inverse without damping.
constexpr double kLeastDamping = 1e8;
constexpr double kTolerance = 1e-6;  // of the cost

/// A sighting in its standard deviations.
struct SightCost {
  const Eigen::Isometry3d* T_frame_anchor;
  Eigen::Vector2d x;
  double weight;

  template <class T>
  bool operator()(const T* pose, const T* m, T* residual) const {
    using Vector = Eigen::Matrix<T, 3, 1>;
    const Eigen::Map<const Vector> t(pose);
    const Eigen::Map<const Eigen::Quaternion<T>> q(pose + 3);
    const Vector ray = T_frame_anchor->linear() * Vector(m[0], m[1], T(1.0));
    const Vector p = q.conjugate() * Vector(ray + m[2] * (T_frame_anchor->translation() - t));
    if (!(p.z() > T(kBehind))) return false;
    residual[0] = weight * (p.x() / p.z() - x.x());
    residual[1] = weight * (p.y() / p.z() - x.y());
    return true;
  }
};

/// Asks between iterations.
class StopCallback : public ceres::IterationCallback {
 public:
  explicit StopCallback(const std::function<bool()>& stop) : stop_(stop) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary&) override {
    return stop_ && stop_() ? ceres::SOLVER_ABORT : ceres::SOLVER_CONTINUE;
  }

 private:
  const std::function<bool()>& stop_;
};

/// The drive as Ceres moves it.
struct Scene {
  std::vector<PoseBlock> poses;
  std::vector<GlobalPatch> patches;
  std::vector<LoopConstraint> edges;  ///< loops that are not among the patches
};

struct Solution {
  bool usable = false, stopped = false;
  int iterations = 0;
};

/// [σ] of a sighting; empty for a patch behind the camera.
std::optional<Eigen::Vector2d> residual_of(const Scene& scene, const GlobalPatch& patch,
                                           const PatchSighting& seen) {
  const SightCost cost{&patch.T_frame_anchor, seen.x.cast<double>(),
                       1.0 / static_cast<double>(seen.point_sigma)};
  Eigen::Vector2d residual;
  if (!cost(scene.poses[seen.keyframe].data(), patch.m.data(), residual.data())) return {};
  return residual;
}

void add_patches(Scene& scene, ceres::LossFunction* loss, ceres::ParameterBlockOrdering& order,
                 ceres::Problem& problem) {
  for (GlobalPatch& patch : scene.patches) {
    if (patch.sightings.empty()) continue;
    for (const PatchSighting& seen : patch.sightings) {
      auto* cost = new ceres::AutoDiffCostFunction<SightCost, 2, 7, 3>(
          new SightCost{&patch.T_frame_anchor, seen.x.cast<double>(),
                        1.0 / static_cast<double>(seen.point_sigma)});
      problem.AddResidualBlock(cost, loss, scene.poses[seen.keyframe].data(), patch.m.data());
    }
    order.AddElementToGroup(patch.m.data(), 0);
  }
  for (PoseBlock& pose : scene.poses) order.AddElementToGroup(pose.data(), 1);
}

Solution solve(const std::vector<LoopKeyframe>& keyframes, const ClosedGraph& closed,
               const GlobalOptions& asked, const std::function<bool()>& stop, Scene& scene) {
  ceres::Problem::Options borrowing;
  borrowing.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::ScaledLoss loss(new ceres::CauchyLoss(1.0), 1.0 / kShared, ceres::TAKE_OWNERSHIP);
  ceres::Problem problem(borrowing);
  add_poses(scene.poses, closed.group, problem);
  add_steps(keyframes, scene.poses, problem);
  for (const LoopConstraint& loop : scene.edges) {
    problem.AddResidualBlock(loop_cost(loop), nullptr, scene.poses[loop.first].data(),
                             scene.poses[loop.second].data());
  }
  ceres::Solver::Options options;
  options.linear_solver_ordering = std::make_shared<ceres::ParameterBlockOrdering>();
  add_patches(scene, &loss, *options.linear_solver_ordering, problem);
  StopCallback callback(stop);
  options.callbacks.push_back(&callback);
  options.linear_solver_type = ceres::SPARSE_SCHUR;
  options.max_num_iterations = asked.max_iterations;
  options.function_tolerance = kTolerance;
  options.max_trust_region_radius = kLeastDamping;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  const int steps = summary.num_successful_steps + summary.num_unsuccessful_steps;
  return {summary.IsSolutionUsable(), summary.termination_type == ceres::USER_FAILURE, steps};
}

/// Takes out what the solution is far from. @return how many observations
std::size_t take_out_far(Scene& scene) {
  std::size_t before = observations_of(scene.patches);
  for (GlobalPatch& patch : scene.patches) {
    const auto far = [&](const PatchSighting& seen) {
      const auto residual = residual_of(scene, patch, seen);
      return !residual || !(residual->squaredNorm() < kGate);
    };
    SharedPatch& all = patch.sightings;
    all.erase(std::remove_if(all.begin(), all.end(), far), all.end());
    if (all.size() < 2) all.clear();
  }
  return before - observations_of(scene.patches);
}

/// [px] of all sightings of the one scene's patches by the poses and patches of the other.
double rms_of(const Scene& which, const Scene& where, double focal_px) {
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < which.patches.size(); ++i) {
    for (const PatchSighting& seen : which.patches[i].sightings) {
      const auto residual = residual_of(where, where.patches[i], seen);
      if (!residual) continue;
      sum += (residual->cast<double>() * static_cast<double>(seen.point_sigma)).squaredNorm();
      ++count;
    }
  }
  return count > 0 ? focal_px * std::sqrt(sum / static_cast<double>(count)) : 0.0;
}

/// Which loops enter as edges: those that too few patches are left of.
std::vector<LoopConstraint> loops_as_edges(const std::vector<LoopConstraint>& loops,
                                           const std::vector<GlobalPatch>& shared) {
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> patches;
  for (const GlobalPatch& patch : shared) {
    for (const PatchSighting& seen : patch.sightings) {
      ++patches[{patch.sightings.front().keyframe, seen.keyframe}];
    }
  }
  std::vector<LoopConstraint> edges;
  for (const LoopConstraint& loop : loops) {
    const auto at = patches.find({loop.first, loop.second});
    if (at == patches.end() || at->second < kEnoughShared) edges.push_back(loop);
  }
  return edges;
}

/// By the first keyframe of a group. Where there is no loop nothing is new to the window.
std::vector<bool> groups_with_loops(const ClosedGraph& closed) {
  std::vector<bool> with(closed.group.size(), false);
  for (const LoopConstraint& loop : closed.loops) with[closed.group[loop.second]] = true;
  return with;
}

void forget_groups_without_loops(const ClosedGraph& closed, std::vector<GlobalPatch>& tracks) {
  const std::vector<bool> with = groups_with_loops(closed);
  const auto idle = [&](const GlobalPatch& patch) {
    return !with[closed.group[patch.sightings.front().keyframe]];
  };
  tracks.erase(std::remove_if(tracks.begin(), tracks.end(), idle), tracks.end());
}

/// Patches within the bounds: fewer of a keyframe where there are too many in all.
std::vector<GlobalPatch> bounded(const std::vector<GlobalPatch>& all, std::size_t keyframes,
                                 const GlobalOptions& options) {
  // Tracks and loops are bounded alike, one after the other.
  const auto most = static_cast<std::size_t>(options.max_observations) / 2;
  auto each = static_cast<std::size_t>(options.patches);
  std::vector<GlobalPatch> patches = chosen(all, keyframes, each);
  while (observations_of(patches) > most && each > kFewestPatches) {
    each = std::max(kFewestPatches, std::min(each - 1, each * most / observations_of(patches)));
    patches = chosen(all, keyframes, each);
  }
  return patches;
}

Scene scene_of(std::size_t keyframes, const ClosedGraph& closed, const DrivePatches& drive,
               const GlobalOptions& options, GlobalReport& report) {
  Scene scene;
  std::vector<GlobalPatch> tracks = patches_of_tracks(drive, closed.T_first_cam);
  forget_groups_without_loops(closed, tracks);
  const std::vector<GlobalPatch> loops = patches_of_loops(closed.loops, closed.T_first_cam);
  std::vector<GlobalPatch> shared = bounded(loops, keyframes, options);
  scene.patches = bounded(tracks, keyframes, options);
  report.passed_over = tracks.size() + loops.size() - scene.patches.size() - shared.size();
  report.inconsistent = keep_affine_consistent(closed.T_first_cam, shared);
  report.inconsistent += keep_affine_consistent(closed.T_first_cam, scene.patches);
  report.shared = shared.size();
  scene.edges = loops_as_edges(closed.loops, shared);
  report.loops = closed.loops.size() - scene.edges.size();
  scene.patches.insert(scene.patches.end(), std::make_move_iterator(shared.begin()),
                       std::make_move_iterator(shared.end()));
  for (const Eigen::Isometry3d& T : closed.T_first_cam) scene.poses.push_back(to_block(T));
  return scene;
}

bool is_finite(const Scene& scene) {
  return std::all_of(scene.poses.begin(), scene.poses.end(), [](const PoseBlock& pose) {
    return std::all_of(pose.begin(), pose.end(), [](double v) { return std::isfinite(v); });
  });
}

/// Where the tracks' patches are.
void tell_points(const Scene& scene, std::vector<std::optional<Eigen::Vector3d>>& points) {
  for (const GlobalPatch& patch : scene.patches) {
    if (!patch.track || patch.sightings.empty() || !(patch.m.z() > 0.0)) continue;
    const Eigen::Vector3d X(patch.m.x(), patch.m.y(), 1.0);
    const Eigen::Vector3d point = patch.T_frame_anchor * Eigen::Vector3d(X / patch.m.z());
    if (point.allFinite()) points[*patch.track] = point;
  }
}

void require_known_keyframes(const DrivePatches& drive, std::size_t keyframes) {
  for (const SharedPatch& patch : drive.patches) {
    for (const PatchSighting& seen : patch) {
      require(seen.keyframe < keyframes, "sighting.keyframe", seen.keyframe,
              "below " + std::to_string(keyframes));
      require(seen.point_sigma > 0.0F, "sighting.point_sigma", seen.point_sigma, "positive");
    }
  }
}

}  // namespace

GlobalAdjustment adjust_globally(const std::vector<LoopKeyframe>& keyframes,
                                 const ClosedGraph& closed, const DrivePatches& drive,
                                 const GlobalOptions& options, const std::function<bool()>& stop) {
  options.validate();
  require_known_keyframes(drive, keyframes.size());
  GlobalAdjustment result;
  result.T_first_cam = closed.T_first_cam;
  result.points.resize(drive.patches.size());
  GlobalReport& report = result.report;
  const auto ends = [&](const char* reason) {
    report.reason = reason;
    return result;
  };
  if (closed.loops.empty()) return ends("there is no loop to adjust over");
  const Scene start = scene_of(keyframes.size(), closed, drive, options, report);
  if (observations_of(start.patches) > static_cast<std::size_t>(options.max_observations)) {
    return ends("it would take more than global_ba.max_observations");
  }
  Scene scene = start;
  for (int round = 0; round < 2; ++round) {
    const Solution solution = solve(keyframes, closed, options, stop, scene);
    report.iterations += solution.iterations;
    if (solution.stopped) return ends("it was interrupted");
    if (!solution.usable || !is_finite(scene)) return ends("it found no solution");
    if (round == 0) report.rejected = take_out_far(scene);
  }
  report.observations = observations_of(scene.patches);
  report.patches = static_cast<std::size_t>(
      std::count_if(scene.patches.begin(), scene.patches.end(),
                    [](const GlobalPatch& patch) { return !patch.sightings.empty(); }));
  report.rms_before_px = rms_of(scene, start, drive.focal_px);
  report.rms_after_px = rms_of(scene, scene, drive.focal_px);
  if (!(report.rms_after_px < kWorse * report.rms_before_px)) {
    return ends("it explains the images no better");
  }
  report.adjusted = true;
  const std::vector<bool> closed_by_loops = groups_with_loops(closed);
  for (std::size_t i = 0; i < keyframes.size(); ++i) {
    if (closed_by_loops[closed.group[i]]) result.T_first_cam[i] = to_pose(scene.poses[i]);
  }
  tell_points(scene, result.points);
  return result;
}

}  // namespace oneac
