#include "oneac/robust/motion_evidence.h"

#include "degeneracy/motion_flow.h"

#include "oneac/base/require.h"
#include "oneac/robust/rotation_only.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace oneac {
namespace {

using internal::Flow;
using internal::MotionScore;

// A vehicle climbs by its road's slope and what the levelling is off: 1σ [rad] of 5°.
constexpr double kClimbSigma = 0.09;
// Neither the expectation of direction nor that of length outweighs what many points see.
constexpr double kMostByPrior = 10.0;
// Degrees of freedom a translation has more than a rotation, with its length on the road.
constexpr double kExtraFreedom = 3.0;

/// ½ k log n, the price of k parameters (BIC).
double parameter_cost(double parameters, std::size_t points) {
  return 0.5 * parameters * std::log(std::max<double>(2.0, static_cast<double>(points)));
}

double capped_square(double z) {
  return std::min(0.5 * z * z, kMostByPrior);
}

double kinematics(const Eigen::Vector3d& t, const Eigen::Matrix3d& R_level_cam,
                  const MotionPrior& prior) {
  const double climb = std::asin(std::clamp(R_level_cam.row(1).dot(t), -1.0, 1.0));
  double odds = -capped_square(climb / kClimbSigma);
  if (prior.direction.norm() > 0.0 && std::isfinite(prior.direction_sigma)) {
    const double along = std::abs(prior.direction.normalized().dot(t));
    odds -= capped_square(std::acos(std::min(1.0, along)) / prior.direction_sigma);
  }
  return odds;
}

double inertia(double length, double length_sigma, const MotionPrior& prior) {
  if (!std::isfinite(prior.length_sigma) || !std::isfinite(length_sigma)) return 0.0;
  const double sigma = std::hypot(prior.length_sigma, length_sigma);
  return capped_square(prior.length / sigma) - capped_square((length - prior.length) / sigma);
}

struct Weighed {
  RelativePose pose;
  MotionScore score;
  double log_odds = -std::numeric_limits<double>::infinity();
  MotionReasons reasons;
};

class Judge {
 public:
  Judge(AcSpan acs, const std::vector<double>& sigmas, const Eigen::Matrix3d& R_rest,
        const Eigen::Matrix3d& R_level_cam, const MotionPrior& prior,
        const MotionEvidenceOptions& options)
      : acs_(acs),
        sigmas_(sigmas),
        R_rest_(R_rest),
        R_level_cam_(R_level_cam),
        prior_(prior),
        options_(options),
        resting_(internal::residuals(R_rest, acs, sigmas, options.sigma)) {}

  double rest_cost() const { return internal::resting_cost(resting_, options_); }

  Weighed weigh(const RelativePose& pose) const {
    Weighed w;
    const std::vector<Flow> flows =
        internal::flows(pose, acs_, sigmas_, R_level_cam_, options_.sigma);
    w.score = internal::best_score(flows, resting_, options_);
    w.pose = {pose.R, w.score.backwards ? Eigen::Vector3d(-pose.t) : pose.t};
    w.reasons = w.score.reasons;
    w.reasons.kinematics = kinematics(pose.t, R_level_cam_, prior_);
    w.reasons.inertia = inertia(w.score.length, w.score.length_sigma, prior_);
    w.log_odds = w.score.gain - parameter_cost(kExtraFreedom, acs_.size()) + w.reasons.kinematics +
                 w.reasons.inertia;
    return w;
  }

  std::vector<RelativePose> candidates(const std::vector<RelativePose>& moving) const {
    std::vector<RelativePose> all = moving;
    const Eigen::Vector3d t = direction_of_dissent(acs_, R_rest_, options_.sigma);
    if (t.norm() > 0.0) all.push_back({R_rest_, t});
    all.push_back({R_rest_, expected_direction()});
    return all;
  }

  /// Of the prior; a camera that looks ahead, without one.
  Eigen::Vector3d expected_direction() const {
    if (prior_.direction.norm() > 0.0) return prior_.direction.normalized();
    return -R_level_cam_.row(2).transpose();
  }

 private:
  AcSpan acs_;
  const std::vector<double>& sigmas_;
  Eigen::Matrix3d R_rest_;
  Eigen::Matrix3d R_level_cam_;
  const MotionPrior& prior_;
  const MotionEvidenceOptions& options_;
  std::vector<Eigen::Vector2f> resting_;
};

}  // namespace

const char* to_string(MotionModel model) {
  switch (model) {
    case MotionModel::kStill:
      return "still";
    case MotionModel::kRotation:
      return "rotation";
    case MotionModel::kTranslation:
      return "translation";
  }
  return "unknown";
}

void MotionPrior::validate() const {
  require(direction.allFinite(), "motion_prior.direction", direction.sum(), "finite");
  require(direction_sigma > 0.0, "motion_prior.direction_sigma", direction_sigma, "positive");
  require(std::isfinite(length), "motion_prior.length", length, "finite");
  require(length_sigma > 0.0, "motion_prior.length_sigma", length_sigma, "positive");
}

void MotionEvidenceOptions::validate() const {
  require(sigma > 0.0, "motion_evidence.sigma", sigma, "positive");
  require(affine_sigma > 0.0, "motion_evidence.affine_sigma", affine_sigma, "positive");
  require(outlier_cost > depth_cost, "motion_evidence.outlier_cost", outlier_cost,
          "above depth_cost");
  require(depth_cost > ground_cost, "motion_evidence.depth_cost", depth_cost, "above ground_cost");
  require(ground_cost >= 0.0, "motion_evidence.ground_cost", ground_cost, "at least 0");
  require(mover_cost >= 0.0, "motion_evidence.mover_cost", mover_cost, "at least 0");
  require(slope > 0.0, "motion_evidence.slope", slope, "positive");
  require(road_below > 0.0, "motion_evidence.road_below", road_below, "positive");
}

Eigen::Vector3d direction_of_dissent(AcSpan acs, const Eigen::Matrix3d& R, double sigma) {
  constexpr double kDissents = 4.0;  // sigmas
  constexpr int kRounds = 3;         // of the reweighting; agreeing points converge in two
  std::vector<Eigen::Vector3d> normals;
  std::vector<Eigen::Vector3d> motions;
  for (const AffineCorrespondence& ac : acs) {
    const Eigen::Vector3d y = R * ac.x1.homogeneous();
    if (!(y.z() > 1e-6)) continue;
    const Eigen::Vector3d p = y / y.z();
    if ((ac.x2 - p.head<2>()).squaredNorm() < kDissents * kDissents * sigma * sigma) continue;
    normals.push_back(ac.x2.homogeneous().cross(p));
    motions.push_back(ac.x2.homogeneous() - p);
  }
  if (normals.size() < 3) return Eigen::Vector3d::Zero();
  Eigen::Vector3d t = Eigen::Vector3d::Zero();
  for (int round = 0; round < kRounds; ++round) {
    Eigen::Matrix3d M = Eigen::Matrix3d::Zero();
    for (const Eigen::Vector3d& n : normals) {
      const double z = round == 0 ? 0.0 : n.dot(t) / (kDissents * sigma);
      const double share = 1.0 / (1.0 + z * z);
      // All dissenters count alike at first: by their length the nearest traffic would lead.
      M += share * share * n * n.transpose() / (round == 0 ? n.squaredNorm() : 1.0);
    }
    t = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>().computeDirect(M).eigenvectors().col(0);
  }
  if (!t.allFinite()) return Eigen::Vector3d::Zero();
  return t.normalized();
}

MotionEvidence judge_motion(AcSpan acs, const std::vector<double>& sigmas,
                            const MotionHypotheses& hypotheses, const Eigen::Matrix3d& R_level_cam,
                            const MotionPrior& prior, const MotionEvidenceOptions& options) {
  require(sigmas.empty() || sigmas.size() == acs.size(), "judge_motion: sigmas",
          static_cast<double>(sigmas.size()), "as many as acs, or none");
  MotionEvidence evidence;
  if (acs.size() == 0) return evidence;
  const Judge judge(acs, sigmas, hypotheses.R_rest, R_level_cam, prior, options);
  Weighed best;
  Weighed expected;
  for (const RelativePose& pose : judge.candidates(hypotheses.moving)) {
    expected = judge.weigh(pose);  // the last one is that of the prior
    if (expected.log_odds > best.log_odds) best = expected;
  }
  const double still = internal::resting_cost(
      internal::residuals(Eigen::Matrix3d::Identity(), acs, sigmas, options.sigma), options);
  evidence.rotation_odds = still - judge.rest_cost() - parameter_cost(3.0, acs.size());
  evidence.log_odds = best.log_odds - std::max(0.0, -evidence.rotation_odds);
  evidence.reasons = best.reasons;
  const bool moves = evidence.log_odds > options.decided;
  const Weighed& chosen = moves ? best : expected;
  evidence.direction = chosen.pose.t;
  evidence.length = chosen.score.length;
  evidence.length_sigma = chosen.score.length_sigma;
  if (moves) {
    evidence.model = MotionModel::kTranslation;
    evidence.pose = best.pose;
  } else if (evidence.rotation_odds > 0.0) {
    evidence.model = MotionModel::kRotation;
    evidence.pose.R = hypotheses.R_rest;
  }
  return evidence;
}

}  // namespace oneac
