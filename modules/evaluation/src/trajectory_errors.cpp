#include "oneac/evaluation/trajectory_errors.h"

#include "oneac/geometry/angular_errors.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <numeric>
#include <stdexcept>

namespace oneac {
namespace {

using Poses = std::vector<Eigen::Isometry3d>;

constexpr std::size_t kStartStep = 5;     // every fifth frame starts a subsequence
constexpr double kSmallestSpread = 1e-9;  // [m] below it a trajectory stands still

Eigen::Matrix3Xd positions(const Poses& poses) {
  Eigen::Matrix3Xd points(3, static_cast<Eigen::Index>(poses.size()));
  for (std::size_t k = 0; k < poses.size(); ++k) {
    points.col(static_cast<Eigen::Index>(k)) = poses[k].translation();
  }
  return points;
}

std::vector<double> travelled(const Poses& poses) {
  std::vector<double> distance{0.0};
  for (std::size_t k = 1; k < poses.size(); ++k) {
    const double step = (poses[k].translation() - poses[k - 1].translation()).norm();
    distance.push_back(distance.back() + step);
  }
  return distance;
}

/// (E_i⁻¹ E_j)⁻¹ (P_i⁻¹ P_j): what is left of the reference's motion after the estimate's.
Eigen::Isometry3d motion_error(const MatchedTrajectories& m, std::size_t i, std::size_t j) {
  const Eigen::Isometry3d estimate = m.estimate[i].inverse() * m.estimate[j];
  return estimate.inverse() * (m.reference[i].inverse() * m.reference[j]);
}

double angle_of(const Eigen::Isometry3d& T) {
  return rotation_error(T.linear(), Eigen::Matrix3d::Identity());
}

std::vector<double> subsequence_lengths(double total) {
  const auto shorter_than_total = [total](std::vector<double> lengths) {
    const auto last = std::find_if(lengths.begin(), lengths.end(),
                                   [total](double length) { return !(length < total); });
    lengths.erase(last, lengths.end());
    return lengths;
  };
  auto lengths = shorter_than_total({100, 200, 300, 400, 500, 600, 700, 800});
  return lengths.empty() ? shorter_than_total({20, 40, 60, 80, 100}) : lengths;
}

void add_subsequences(const MatchedTrajectories& matched, const std::vector<double>& distance,
                      double length, SubsequenceErrors& sum) {
  for (std::size_t i = 0; i < distance.size(); i += kStartStep) {
    const auto end = std::find_if(distance.begin() + static_cast<std::ptrdiff_t>(i), distance.end(),
                                  [&](double d) { return d - distance[i] >= length; });
    if (end == distance.end()) return;
    const auto j = static_cast<std::size_t>(end - distance.begin());
    const Eigen::Isometry3d error = motion_error(matched, i, j);
    sum.translation += error.translation().norm() / length;
    sum.rotation += angle_of(error) / length;
    ++sum.count;
  }
}

void add_relative_errors(const MatchedTrajectories& matched, TrajectoryErrors& errors) {
  std::vector<double> translation, rotation;
  for (std::size_t k = 1; k < matched.estimate.size(); ++k) {
    const Eigen::Isometry3d error = motion_error(matched, k - 1, k);
    translation.push_back(error.translation().norm());
    rotation.push_back(angle_of(error));
  }
  errors.rpe_translation = statistics_of(translation);
  errors.rpe_rotation = statistics_of(rotation);
}

void add_absolute_errors(const MatchedTrajectories& matched, TrajectoryErrors& errors) {
  const Eigen::Matrix3Xd x = positions(matched.estimate);
  const Eigen::Matrix3Xd y = positions(matched.reference);
  const Similarity S = align(x, y, errors.alignment);
  std::vector<double> distance;
  for (Eigen::Index k = 0; k < x.cols(); ++k) distance.push_back((S * x.col(k) - y.col(k)).norm());
  errors.ape = *statistics_of(distance);
  errors.aligned_scale = S.scale;
}

}  // namespace

Alignment alignment_from_name(const std::string& name) {
  for (Alignment alignment : {Alignment::kNone, Alignment::kSe3, Alignment::kSim3}) {
    if (name == name_of(alignment)) return alignment;
  }
  throw std::invalid_argument("alignment '" + name + "', must be none, se3 or sim3");
}

std::string name_of(Alignment alignment) {
  constexpr std::array<const char*, 3> kNames{"none", "se3", "sim3"};
  return kNames[static_cast<std::size_t>(alignment)];
}

Similarity align(const Eigen::Matrix3Xd& x, const Eigen::Matrix3Xd& y, Alignment alignment) {
  Similarity S;
  if (alignment == Alignment::kNone) return S;
  const Eigen::Vector3d mean_x = x.rowwise().mean();
  const Eigen::Vector3d mean_y = y.rowwise().mean();
  const Eigen::Matrix3Xd dx = x.colwise() - mean_x;
  const Eigen::Matrix3Xd dy = y.colwise() - mean_y;
  if (dx.norm() > kSmallestSpread && dy.norm() > kSmallestSpread) {
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(dy * dx.transpose(),
                                                Eigen::ComputeFullU | Eigen::ComputeFullV);
    const double handedness =
        svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0 ? -1.0 : 1.0;
    const Eigen::Vector3d sign(1.0, 1.0, handedness);  // a rotation, never a mirror
    S.R = svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
    if (alignment == Alignment::kSim3) S.scale = svd.singularValues().dot(sign) / dx.squaredNorm();
  }
  S.t = mean_y - S.scale * (S.R * mean_x);
  return S;
}

double path_length(const std::vector<Eigen::Isometry3d>& poses) {
  return travelled(poses).back();
}

std::optional<SubsequenceErrors> subsequence_errors(const MatchedTrajectories& matched) {
  const std::vector<double> distance = travelled(matched.reference);
  SubsequenceErrors sum;
  for (double length : subsequence_lengths(distance.back())) {
    add_subsequences(matched, distance, length, sum);
  }
  if (sum.count == 0) return std::nullopt;
  sum.translation /= static_cast<double>(sum.count);
  sum.rotation /= static_cast<double>(sum.count);
  return sum;
}

TrajectoryErrors trajectory_errors(const MatchedTrajectories& matched, Alignment alignment) {
  if (matched.estimate.empty() || matched.estimate.size() != matched.reference.size()) {
    throw std::invalid_argument("MatchedTrajectories: estimate has " +
                                std::to_string(matched.estimate.size()) + " poses, reference " +
                                std::to_string(matched.reference.size()) +
                                "; must be equal and at least 1");
  }
  TrajectoryErrors errors;
  errors.frames = matched.estimate.size();
  errors.length = path_length(matched.reference);
  errors.alignment = alignment;
  add_absolute_errors(matched, errors);
  add_relative_errors(matched, errors);
  errors.subsequences = subsequence_errors(matched);
  if (errors.length > kSmallestSpread) {
    errors.scale_error = path_length(matched.estimate) / errors.length - 1.0;
  }
  return errors;
}

}  // namespace oneac
