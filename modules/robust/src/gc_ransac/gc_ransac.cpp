#include "oneac/robust/gc_ransac.h"

#include "gc_ransac/gc_ransac_loop.h"

#include "oneac/base/check_bounds.h"
#include "oneac/base/require.h"
#include "oneac/geometry/essential.h"
#include "oneac/geometry/homography.h"
#include "oneac/robust/finite_acs.h"
#include "oneac/robust/point_set.h"
#include "oneac/robust/polish.h"
#include "oneac/solvers/essential_8pc.h"

#include <cmath>
#include <utility>

namespace oneac {
namespace {

// A minimal model of planar motion is off by the suspension's pitch, some pixels; the first
// polishing passes look wider than the threshold to get there.
constexpr double kWideLoss = 3.0;
constexpr int kRefitIterations = 6;

/// Any of the four motions of E obeys the same epipolar equations: good enough to start from.
RelativePose any_motion(const Eigen::Matrix3d& E) {
  return decompose_essential(E)[0];
}

class EpipolarSpace : public internal::ModelSpace {
 public:
  EpipolarSpace(AcSpan acs, const Eigen::Matrix3d& R_level_cam, const Solver& solver,
                double threshold, const std::string& lo_model)
      : acs_(acs),
        solver_(solver),
        Q_(R_level_cam),
        threshold_(threshold),
        linear_(lo_model != "polish"),
        polishing_(lo_model != "8pc"),
        scored_(acs) {
    if (solver_.levelled()) level();
    gathered_.reserve(acs.size());
  }

  AcSpan points() const override { return acs_; }
  std::size_t sample_size() const override { return solver_.sample; }
  bool approximate() const override { return solver_.levelled(); }

  EssentialSet solve(const std::size_t* sample) override {
    AffineCorrespondence drawn[kLargestSample];
    const AcSpan from = solver_.levelled() ? AcSpan(levelled_) : acs_;
    for (std::size_t i = 0; i < solver_.sample; ++i) drawn[i] = from[sample[i]];
    EssentialSet models = solver_.run.essentials({drawn, solver_.sample});
    if (!solver_.levelled()) return models;
    for (std::size_t i = 0; i < models.size(); ++i) models[i] = Q_.transpose() * models[i] * Q_;
    return models;
  }

  double cost(const Eigen::Matrix3d& E, double give_up) override {
    return msac_cost(E, scored_, threshold_, give_up);
  }

  void squared_errors(const Eigen::Matrix3d& E, std::vector<double>& errors) override {
    errors.resize(acs_.size());
    for (std::size_t i = 0; i < acs_.size(); ++i) {
      const double r = sampson_distance(E, acs_[i].x1, acs_[i].x2) / threshold_;
      errors[i] = r * r;
    }
  }

  int refits() const override { return linear_ && polishing_ ? 2 : 1; }

  bool refit(int way, const std::vector<std::uint8_t>& labels, Eigen::Matrix3d& E) override {
    const AcSpan inliers = internal::gather(acs_, labels, gathered_);
    if (!linear_ || way == 1) {
      E = essential_matrix(
          polish(any_motion(E), inliers, {kWideLoss * threshold_, kRefitIterations}).pose);
      return true;
    }
    const auto linear = essential_8pc(inliers);
    if (linear.empty()) return false;
    E = linear[0];
    return true;
  }

 private:
  /// A correspondence that the levelled camera cannot see stays as it is: it makes hypotheses that
  /// nobody supports.
  void level() {
    levelled_.reserve(acs_.size());
    for (const AffineCorrespondence& ac : acs_) {
      levelled_.push_back(rotate_views(ac, Q_, Q_).value_or(ac));
    }
  }

  AcSpan acs_;
  const Solver& solver_;
  Eigen::Matrix3d Q_;
  double threshold_;
  bool linear_;
  bool polishing_;
  PointSet scored_;
  std::vector<AffineCorrespondence> levelled_;
  std::vector<AffineCorrespondence> gathered_;
};

/// Polished on all points: a smooth robust loss instead of MSAC, whose inliers switch.
Eigen::Matrix3d polished(EpipolarSpace& space, const internal::LoopResult& found,
                         double threshold) {
  const RelativePose start = any_motion(found.model);
  return essential_matrix(
      polish(start, space.points(), {threshold, PolishOptions{}.max_iterations}).pose);
}

/// Fills in pose, inliers and cost of a model; leaves kTooFew when too few obey it.
void conclude(const Eigen::Matrix3d& E, EpipolarSpace& space, const FiniteAcs& finite,
              std::size_t min_inliers, RobustResult& result) {
  std::vector<double> errors;
  space.squared_errors(E, errors);
  std::vector<bool> flags(errors.size());
  std::vector<AffineCorrespondence> inliers;
  for (std::size_t k = 0; k < errors.size(); ++k) {
    flags[k] = errors[k] <= 1.0;
    if (flags[k]) inliers.push_back(finite.acs()[k]);
  }
  const std::size_t all = result.inliers.size(), taken = finite.acs().size();
  result.inliers = finite.spread(std::move(flags));
  result.inlier_count = inliers.size();
  result.cost = space.cost(E, static_cast<double>(taken) + 1.0) + static_cast<double>(all - taken);
  if (result.inlier_count < min_inliers) return;
  const auto pose = pose_from_essential(E, inliers);
  if (pose.empty()) return;
  result.pose = pose[0];
  result.status = PoseStatus::kOk;
}

}  // namespace

void GcRansacOptions::validate() const {
  check_bounds("gc_ransac", *this);
  require(min_iterations <= max_iterations, "gc_ransac.min_iterations", min_iterations,
          "from 1 to max_iterations");
}

RobustResult gc_ransac(AcSpan acs, const Eigen::Matrix3d& R_level_cam, double focal_px,
                       const Solver& solver, std::uint64_t seed, const GcRansacOptions& options) {
  options.validate();
  require(focal_px > 0.0 && std::isfinite(focal_px), "gc_ransac.focal_px", focal_px,
          "positive and finite");
  RobustResult result;
  result.inliers.assign(acs.size(), false);
  result.cost = static_cast<double>(acs.size());
  const FiniteAcs finite(acs);
  const auto min_inliers = static_cast<std::size_t>(options.min_inliers);
  if (finite.acs().size() < min_inliers) return result;
  const double threshold = options.threshold_px / focal_px;
  EpipolarSpace space(finite.acs(), R_level_cam, solver, threshold, options.lo_model);
  const internal::LoopResult found = internal::gc_ransac_loop(space, seed, options);
  result.statistics = found.statistics;
  if (!found.found) return result;
  conclude(polished(space, found, threshold), space, finite, min_inliers, result);
  return result;
}

}  // namespace oneac
