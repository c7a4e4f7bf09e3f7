#include "oneac/refine/two_view.h"

#include "epipolar_costs.h"
#include "two_view_information.h"

#include "oneac/base/check_bounds.h"
#include "oneac/base/require.h"
#include "oneac/geometry/essential.h"

#include <ceres/loss_function.h>
#include <ceres/manifold.h>
#include <ceres/problem.h>
#include <ceres/sized_cost_function.h>
#include <ceres/solver.h>
#include <ceres/sphere_manifold.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <string>
#include <utility>

namespace oneac {
namespace {

// Relative change of the cost that ends the search: of a cost near 300 it is 3e-4, a fiftieth of a
// standard deviation of the pose.
constexpr double kFunctionTolerance = 1e-6;

/// Of every correspondence: its own, where it is known, beside what no model of a camera explains.
std::vector<CorrespondenceNoise> noise_of(std::size_t count, const std::vector<double>& sigmas,
                                          double focal_px, const RefineOptions& options) {
  std::vector<CorrespondenceNoise> noise(count,
                                         {options.point_noise_px / focal_px, options.affine_noise});
  for (std::size_t i = 0; i < sigmas.size(); ++i) {
    if (!(sigmas[i] > 0.0)) continue;
    noise[i].point = std::hypot(sigmas[i], options.model_noise_px / focal_px);
  }
  return noise;
}

/// Why the pair cannot be refined; empty when it can.
std::optional<RefineStatus> refusal(const std::vector<AffineCorrespondence>& acs,
                                    const std::vector<bool>& inliers, const RelativePose& start,
                                    std::size_t inlier_count, int min_inliers) {
  if (!start.is_finite()) return RefineStatus::kNotFinite;
  for (std::size_t i = 0; i < acs.size(); ++i) {
    if (inliers[i] && !acs[i].is_finite()) return RefineStatus::kNotFinite;
  }
  if (inlier_count < static_cast<std::size_t>(min_inliers)) return RefineStatus::kTooFew;
  if (!(start.t.norm() > 0.0)) return RefineStatus::kNoTranslation;
  return std::nullopt;
}

std::vector<bool> affine_consistent(const std::vector<AffineCorrespondence>& acs,
                                    const std::vector<bool>& inliers, const RelativePose& pose,
                                    const std::vector<CorrespondenceNoise>& noise,
                                    double gate_sigmas) {
  const Eigen::Matrix3d E = essential_matrix(pose);
  std::vector<bool> consistent(acs.size(), false);
  for (std::size_t i = 0; i < acs.size(); ++i) {
    consistent[i] = inliers[i] && affine_term(E, acs[i], noise[i]).r.norm() <= gate_sigmas;
  }
  return consistent;
}

template <int N>
bool is_finite(const EpipolarTerm<N>& term) {
  bool finite = term.r.allFinite();
  for (const Eigen::Matrix3d& dE : term.dE) finite = finite && dE.allFinite();
  return finite;
}

/// False when finite inputs are so large that a term overflows: Ceres would log that.
bool are_finite_at(const RelativePose& pose, const TwoViewTerms& terms) {
  const Eigen::Matrix3d E = essential_matrix(pose);
  for (std::size_t i = 0; i < terms.acs.size(); ++i) {
    const AffineCorrespondence& ac = terms.acs[i];
    if (terms.with_point[i] && !is_finite(point_term(E, ac, terms.noise[i]))) return false;
    if (terms.with_affine[i] && !is_finite(affine_term(E, ac, terms.noise[i]))) return false;
  }
  return true;
}

std::size_t count_true(const std::vector<bool>& flags) {
  return static_cast<std::size_t>(std::count(flags.begin(), flags.end(), true));
}

/// (t̂ − expected) / σ, two of whose three components count on the sphere.
class DirectionCost : public ceres::SizedCostFunction<3, 3> {
 public:
  explicit DirectionCost(const DirectionPrior& prior) : prior_(prior) {}
  bool Evaluate(const double* const* parameters, double* residuals,
                double** jacobians) const override {
    const Eigen::Map<const Eigen::Vector3d> t(parameters[0]);
    Eigen::Map<Eigen::Vector3d> r(residuals);
    r = (t - prior_.direction) / prior_.sigma;
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      Eigen::Map<Eigen::Matrix3d> J(jacobians[0]);  // symmetric: rows and columns are alike
      J = Eigen::Matrix3d::Identity() / prior_.sigma;
    }
    return true;
  }

 private:
  DirectionPrior prior_;
};

/// Information of a direction that is expected, along t nothing.
Eigen::Matrix<double, 6, 6> information_of(const DirectionPrior& prior, const Eigen::Vector3d& t) {
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
  if (!(prior.sigma > 0.0)) return information;
  information.bottomRightCorner<3, 3>() =
      (Eigen::Matrix3d::Identity() - t * t.transpose()) / (prior.sigma * prior.sigma);
  return information;
}

/// The Ceres problem of one pair; owns what the problem points to.
class TwoViewProblem {
 public:
  TwoViewProblem(const TwoViewTerms& terms, const RelativePose& start, const DirectionPrior& prior)
      : loss_(terms.loss_sigmas),
        expected_(prior),
        rotation_(start.R),
        direction_(start.t),
        problem_(borrowing()) {
    rotation_.normalize();
    problem_.AddParameterBlock(rotation_.coeffs().data(), 4, &rotation_manifold_);
    problem_.AddParameterBlock(direction_.data(), 3, &sphere_);
    for (std::size_t i = 0; i < terms.acs.size(); ++i) {
      if (terms.with_point[i]) add(&points_.emplace_back(terms.acs[i], terms.noise[i]));
      if (terms.with_affine[i]) add(&affinities_.emplace_back(terms.acs[i], terms.noise[i]));
    }
    if (prior.sigma > 0.0) problem_.AddResidualBlock(&expected_, nullptr, direction_.data());
  }

  ceres::Solver::Summary solve(int max_iterations) {
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.max_num_iterations = max_iterations;
    options.function_tolerance = kFunctionTolerance;
    options.num_threads = 1;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem_, &summary);
    return summary;
  }

  [[nodiscard]] RelativePose pose() const {
    return {rotation_.normalized().toRotationMatrix(), direction_.normalized()};
  }

 private:
  static ceres::Problem::Options borrowing() {
    ceres::Problem::Options options;
    options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    return options;
  }
  void add(ceres::CostFunction* cost) {
    problem_.AddResidualBlock(cost, &loss_, rotation_.coeffs().data(), direction_.data());
  }

  ceres::CauchyLoss loss_;
  DirectionCost expected_;
  ceres::EigenQuaternionManifold rotation_manifold_;
  ceres::SphereManifold<3> sphere_;
  std::deque<PointCost> points_;  // a deque: elements stay where the problem points
  std::deque<AffineCost> affinities_;
  Eigen::Quaterniond rotation_;
  Eigen::Vector3d direction_;
  ceres::Problem problem_;
};

/// Solves from `start`, |t| = 1. Leaves result.pose alone unless the outcome is usable.
void minimise(const TwoViewTerms& terms, const RelativePose& start, const DirectionPrior& prior,
              int max_iterations, RefineResult& result) {
  TwoViewProblem problem(terms, start, prior);
  const ceres::Solver::Summary summary = problem.solve(max_iterations);
  const RelativePose refined = problem.pose();
  result.initial_cost = summary.initial_cost;
  result.final_cost = summary.initial_cost;
  result.iterations = summary.num_successful_steps + summary.num_unsuccessful_steps;
  const bool lower = summary.final_cost <= summary.initial_cost;
  if (!summary.IsSolutionUsable() || !refined.is_finite() || !lower) return;
  result.status = summary.termination_type == ceres::CONVERGENCE ? RefineStatus::kConverged
                                                                 : RefineStatus::kStopped;
  result.final_cost = summary.final_cost;
  const auto told = two_view_information(terms, refined, information_of(prior, refined.t));
  result.information = told.information;
  result.shared_covariance = told.shared;
  result.pose = refined;
}

}  // namespace

const char* to_string(RefineStatus status) {
  switch (status) {
    case RefineStatus::kConverged:
      return "converged";
    case RefineStatus::kStopped:
      return "stopped";
    case RefineStatus::kTooFew:
      return "too_few";
    case RefineStatus::kNoTranslation:
      return "no_translation";
    case RefineStatus::kNotFinite:
      return "not_finite";
    case RefineStatus::kFailed:
      return "failed";
  }
  return "unknown";
}

void RefineOptions::validate() const {
  check_bounds("refine", *this);
}

RefineResult refine_two_view(const std::vector<AffineCorrespondence>& acs,
                             const std::vector<bool>& inliers, const RelativePose& start,
                             double focal_px, const RefineOptions& options,
                             const KnownOfPair& known) {
  options.validate();
  require(focal_px > 0.0 && std::isfinite(focal_px), "refine.focal_px", focal_px,
          "positive and finite");
  require(inliers.size() == acs.size(), "refine.inliers", static_cast<double>(inliers.size()),
          "one per correspondence");
  require(known.point_sigmas.empty() || known.point_sigmas.size() == acs.size(),
          "refine.point_sigmas", static_cast<double>(known.point_sigmas.size()),
          "one per correspondence, or none");
  RefineResult result;
  result.affine_consistent.assign(acs.size(), false);
  if (start.is_finite()) result.pose = start;
  const std::size_t inlier_count = count_true(inliers);
  if (const auto why = refusal(acs, inliers, start, inlier_count, options.min_inliers)) {
    result.status = *why;
    return result;
  }
  const double length = start.t.norm();
  const RelativePose unit{start.R, start.t / length};
  std::vector<CorrespondenceNoise> noise =
      noise_of(acs.size(), known.point_sigmas, focal_px, options);
  result.affine_consistent =
      affine_consistent(acs, inliers, unit, noise, options.affine_gate_sigmas);
  result.affine_count = count_true(result.affine_consistent);
  result.affine_used = inlier_count < static_cast<std::size_t>(options.affine_terms_below);

  const std::vector<bool> none(acs.size(), false);
  const TwoViewTerms terms{acs, inliers, result.affine_used ? result.affine_consistent : none,
                           std::move(noise), options.loss_sigmas};
  if (!are_finite_at(unit, terms)) {
    result.status = RefineStatus::kNotFinite;
    return result;
  }
  minimise(terms, unit, known.direction, options.max_iterations, result);
  if (result.usable()) result.pose.t *= length;
  return result;
}

}  // namespace oneac
