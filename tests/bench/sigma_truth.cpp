// Are the stated sigmas true? Errors of a run against reference poses, over the sigmas that its
// files state: the share within 2 sigma and the largest, in sigmas. A row of
// docs/benchmarks/sigma.md.
//
//   oneac_bench_sigma_truth RUN_FOLDER REFERENCE [--aligned] [--reference-noise DEG METRES]
//
// --aligned takes out one rotation of the reference's camera against the images', the mean of the
// errors of direction (a reference by GPS and IMU); --reference-noise adds 1 sigma of a reference
// pose, rotation and position per axis.

#include "oneac/evaluation/covariance_io.h"
#include "oneac/evaluation/pair_errors.h"
#include "oneac/evaluation/relative_poses_io.h"
#include "oneac/evaluation/trajectory_io.h"
#include "oneac/geometry/angles.h"
#include "oneac/geometry/tangent_basis.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

namespace {

using namespace oneac;

struct Setup {
  std::filesystem::path run, reference;
  bool aligned = false;
  double turn_noise = 0.0;      // [rad] of a reference pose
  double position_noise = 0.0;  // [m]
};

/// A pair with its truth.
struct Judged {
  RelativePoseRow row;
  CovarianceRow sure;
  RelativePose truth;

  [[nodiscard]] double true_step() const { return truth.t.norm(); }
};

/// Errors in sigmas, a component each.
struct Scores {
  std::vector<double> z;

  void add(const Eigen::VectorXd& error, const Eigen::MatrixXd& covariance) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axes(covariance);
    const Eigen::VectorXd along = axes.eigenvectors().transpose() * error;
    for (Eigen::Index i = 0; i < along.size(); ++i) {
      z.push_back(std::abs(along[i]) / std::sqrt(std::max(axes.eigenvalues()[i], 1e-24)));
    }
  }
  void add(double error, double variance) {
    add(Eigen::VectorXd::Constant(1, error), Eigen::MatrixXd::Constant(1, 1, variance));
  }
  [[nodiscard]] std::string cell() const {
    if (z.empty()) return "–";
    const auto within = std::count_if(z.begin(), z.end(), [](double s) { return s <= 2.0; });
    double squares = 0.0;
    for (const double s : z) squares += s * s;
    char text[64];
    std::snprintf(text, sizeof text, "%.0f %% / %.1f / %.2f",
                  100.0 * static_cast<double>(within) / static_cast<double>(z.size()),
                  *std::max_element(z.begin(), z.end()),
                  std::sqrt(squares / static_cast<double>(z.size())));
    return text;
  }
};

Eigen::Vector3d rotation_vector(const Eigen::Matrix3d& R) {
  const Eigen::AngleAxisd turn(R);
  return turn.angle() * turn.axis();
}

RelativePose motion_between(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  const Eigen::Isometry3d T = b.inverse() * a;
  return {T.linear(), T.translation()};
}

std::vector<Judged> judged_pairs(const Setup& setup, const Trajectory& reference) {
  const auto rows = read_relative_poses(setup.run / "relative_poses.csv");
  const auto sure = read_covariances(setup.run / "covariance.csv");
  std::vector<Judged> pairs;
  for (std::size_t i = 0; i < rows.size() && i < sure.size(); ++i) {
    if (rows[i].index2 >= reference.poses.size()) break;
    pairs.push_back(
        {rows[i], sure[i],
         motion_between(reference.poses[rows[i].index1], reference.poses[rows[i].index2])});
  }
  return pairs;
}

/// Error of the direction, rotation vector that takes the true one to the estimated one.
Eigen::Vector3d turn_of_direction(const Judged& pair) {
  const Eigen::Vector3d a = pair.truth.t.normalized(), b = pair.row.T_2_1.t.normalized();
  return a.cross(b);
}

bool has_direction(const Judged& pair) {
  return pair.true_step() > kSmallestTrueStep && pair.row.T_2_1.t.norm() > 0.0;
}

/// The one rotation between the reference's camera and the images'.
Eigen::Matrix3d turn_between(const std::vector<Judged>& pairs) {
  // Rolls about the way are not told by directions: the smallest turn is taken.
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double count = 0.0;
  for (const Judged& pair : pairs) {
    if (!has_direction(pair)) continue;
    sum += turn_of_direction(pair);
    count += 1.0;
  }
  const Eigen::Vector3d turn = count > 0.0 ? Eigen::Vector3d(sum / count) : sum;
  if (!(turn.norm() > 0.0)) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
}

void align(std::vector<Judged>& pairs, const Eigen::Matrix3d& turn) {
  for (Judged& pair : pairs) {
    pair.truth = {turn * pair.truth.R * turn.transpose(), turn * pair.truth.t};
  }
}

struct Verdict {
  Scores length, rotation, direction, position;
};

void judge(const Judged& pair, const Setup& setup, Verdict& verdict) {
  const Eigen::Matrix<double, 6, 6>& C = pair.sure.covariance;
  const double turn = 2.0 * setup.turn_noise * setup.turn_noise;
  const double place = 2.0 * setup.position_noise * setup.position_noise;
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
  verdict.rotation.add(rotation_vector(pair.row.T_2_1.R * pair.truth.R.transpose()),
                       C.topLeftCorner<3, 3>() + turn * I);
  const double length = pair.row.T_2_1.t.norm(), truth = pair.true_step();
  if (pair.row.sigma_length) {
    verdict.length.add(length - truth, *pair.row.sigma_length * *pair.row.sigma_length + place);
  }
  if (!has_direction(pair)) return;
  const Eigen::Matrix<double, 3, 2> basis = tangent_basis(pair.row.T_2_1.t.normalized());
  const Eigen::Matrix2d across =
      basis.transpose() * C.bottomRightCorner<3, 3>() * basis / (length * length);
  const Eigen::Vector2d off = basis.transpose() * pair.truth.t.normalized();
  verdict.direction.add(off,
                        across + (turn + place / (truth * truth)) * Eigen::Matrix2d::Identity());
}

void judge_positions(const std::vector<Judged>& pairs, const Setup& setup,
                     const Trajectory& reference, const Eigen::Matrix3d& turn, Verdict& verdict) {
  const Trajectory estimate = read_kitti(setup.run / "trajectory_camera.kitti");
  if (pairs.empty()) return;
  const Eigen::Isometry3d first = reference.poses[pairs.front().row.index1];
  for (std::size_t i = 0; i < pairs.size() && i + 1 < estimate.poses.size(); ++i) {
    if (!pairs[i].sure.position_sigma) continue;
    const Eigen::Vector3d truth =
        turn * (first.inverse() * reference.poses[pairs[i].row.index2]).translation();
    const Eigen::Vector3d off = estimate.poses[i + 1].translation() - truth;
    for (int axis = 0; axis < 3; ++axis) {
      const double sigma = (*pairs[i].sure.position_sigma)[axis];
      verdict.position.add(off[axis],
                           sigma * sigma + 2.0 * setup.position_noise * setup.position_noise);
    }
  }
}

Setup parse(const std::vector<std::string>& arguments) {
  Setup setup;
  setup.run = arguments.at(0);
  setup.reference = arguments.at(1);
  for (std::size_t i = 2; i < arguments.size(); ++i) {
    if (arguments[i] == "--aligned") setup.aligned = true;
    if (arguments[i] != "--reference-noise") continue;
    setup.turn_noise = std::stod(arguments.at(i + 1)) * kDegree;
    setup.position_noise = std::stod(arguments.at(i + 2));
  }
  return setup;
}

void run(const Setup& setup) {
  const Trajectory reference = read_kitti(setup.reference);
  std::vector<Judged> pairs = judged_pairs(setup, reference);
  const Eigen::Matrix3d turn =
      setup.aligned ? turn_between(pairs) : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
  align(pairs, turn);
  Verdict verdict;
  for (const Judged& pair : pairs) judge(pair, setup, verdict);
  judge_positions(pairs, setup, reference, turn, verdict);
  std::printf("| %s | %zu | %s | %s | %s | %s |\n", setup.run.filename().c_str(), pairs.size(),
              verdict.length.cell().c_str(), verdict.rotation.cell().c_str(),
              verdict.direction.cell().c_str(), verdict.position.cell().c_str());
  if (setup.aligned) {
    std::printf("reference turned by %.2f deg\n", rotation_vector(turn).norm() / kDegree);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr,
                 "sigma_truth RUN_FOLDER REFERENCE [--aligned] [--reference-noise DEG M]\n");
    return 2;
  }
  try {
    run(parse({argv + 1, argv + argc}));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
