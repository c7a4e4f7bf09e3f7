#include "oneac/evaluation/trajectory_io.h"

#include "pose_rows.h"
#include "text_io.h"

#include "oneac/base/error.h"
#include "oneac/base/number_text.h"

#include <Eigen/Dense>

#include <array>
#include <cmath>
#include <stdexcept>

namespace oneac {
namespace {

constexpr std::size_t kKittiColumns = 12;
constexpr std::size_t kTumColumns = 8;
// Files with four digits after the point are still rotations; a scaled or sheared matrix is not.
constexpr double kRotationTolerance = 1e-3;

template <std::size_t N>
std::array<double, N> parse_row(const TextLine& line, const std::string& file, const char* cure) {
  const auto fields = split_at_blanks(line.text);
  if (fields.size() != N) {
    throw InputError(where_in(file, line.number),
                     std::to_string(fields.size()) + " columns, must be " + std::to_string(N),
                     cure);
  }
  std::array<double, N> row{};
  for (std::size_t i = 0; i < N; ++i) {
    const auto value = parse_finite(fields[i]);
    if (!value) {
      throw InputError(where_in(file, line.number),
                       "column " + std::to_string(i + 1) + " is '" + std::string(fields[i]) +
                           "', not a finite number below 1e15",
                       "remove the line or write the file again");
    }
    row[i] = *value;
  }
  return row;
}

std::vector<TextLine> pose_lines(const std::string& text, const std::string& file) {
  auto lines = data_lines(text);
  if (lines.empty()) throw InputError(file, "has no poses", "write or copy it again");
  return lines;
}

void require_finite(const Eigen::Isometry3d& T) {
  if (!T.matrix().allFinite()) throw std::invalid_argument("a pose of a trajectory must be finite");
}

}  // namespace

std::optional<Eigen::Matrix3d> nearest_rotation(const Eigen::Matrix3d& M) {
  const double defect = (M.transpose() * M - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(defect < kRotationTolerance) || M.determinant() < 0.0) return std::nullopt;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(M, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

Eigen::Isometry3d internal::pose_of_matrix(const std::array<double, 12>& v,
                                           const std::string& where) {
  Eigen::Matrix3d M;
  M << v[0], v[1], v[2], v[4], v[5], v[6], v[8], v[9], v[10];
  const auto R = nearest_rotation(M);
  if (!R) {
    throw InputError(where, "columns 1-3, 5-7, 9-11 are not a rotation",
                     "write T_world_camera as the rows r11 r12 r13 tx r21 ... tz");
  }
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = *R;
  T.translation() << v[3], v[7], v[11];
  return T;
}

Eigen::Isometry3d internal::pose_of_quaternion(const std::array<double, 7>& v,
                                               const std::string& where) {
  const Eigen::Quaterniond q(v[6], v[3], v[4], v[5]);
  if (!(std::abs(q.norm() - 1.0) < kRotationTolerance)) {
    throw InputError(where, "columns 5-8 are not a unit quaternion",
                     "write the columns time x y z qx qy qz qw");
  }
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = q.normalized().toRotationMatrix();
  T.translation() << v[0], v[1], v[2];
  return T;
}

void Trajectory::validate() const {
  if (has_times() && times.size() != poses.size()) {
    throw std::invalid_argument("Trajectory.times has " + std::to_string(times.size()) +
                                " rows, must be as many as poses: " + std::to_string(poses.size()));
  }
  for (std::size_t k = 0; k < poses.size(); ++k) {
    if (!poses[k].matrix().allFinite()) {
      throw std::invalid_argument("Trajectory.poses[" + std::to_string(k) + "] must be finite");
    }
  }
  for (std::size_t k = 0; k < times.size(); ++k) {
    if (!std::isfinite(times[k]) || (k > 0 && !(times[k] > times[k - 1]))) {
      throw std::invalid_argument("Trajectory.times[" + std::to_string(k) +
                                  "] must be finite and later than the one before");
    }
  }
}

Trajectory read_kitti(const std::filesystem::path& path) {
  const std::string text = read_text(path);
  Trajectory trajectory;
  for (const TextLine& line : pose_lines(text, path.string())) {
    const auto row = parse_row<kKittiColumns>(
        line, path.string(), "a KITTI file has a 3x4 matrix per line; call a TUM file .tum");
    trajectory.poses.push_back(internal::pose_of_matrix(row, where_in(path.string(), line.number)));
  }
  return trajectory;
}

Trajectory read_tum(const std::filesystem::path& path) {
  const std::string text = read_text(path);
  Trajectory trajectory;
  for (const TextLine& line : pose_lines(text, path.string())) {
    const std::string where = where_in(path.string(), line.number);
    const auto row = parse_row<kTumColumns>(line, path.string(),
                                            "a TUM file has time x y z qx qy qz qw per line");
    if (trajectory.has_times() && !(row[0] > trajectory.times.back())) {
      throw InputError(where, "its time is not later than the one before",
                       "sort the file by time and remove repeated lines");
    }
    trajectory.times.push_back(row[0]);
    trajectory.poses.push_back(internal::pose_of_quaternion(
        {row[1], row[2], row[3], row[4], row[5], row[6], row[7]}, where));
  }
  return trajectory;
}

std::string kitti_line(const Eigen::Isometry3d& T) {
  require_finite(T);
  std::string line;
  for (int row = 0; row < 3; ++row) {
    for (int col = 0; col < 4; ++col) {
      if (!line.empty()) line += ' ';
      line += exact_text(T(row, col));
    }
  }
  return line + '\n';
}

std::string tum_line(double time_s, const Eigen::Isometry3d& T) {
  require_finite(T);
  if (!std::isfinite(time_s)) {
    throw std::invalid_argument("a time of a trajectory must be finite");
  }
  const Eigen::Vector3d p = T.translation();
  Eigen::Quaterniond q(T.linear());
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  std::string line = exact_fixed_text(time_s, kTimeDecimals);
  for (double v : {p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()}) line += ' ' + exact_text(v);
  return line + '\n';
}

std::string format_kitti(const Trajectory& trajectory) {
  trajectory.validate();
  std::string text;
  for (const Eigen::Isometry3d& T : trajectory.poses) text += kitti_line(T);
  return text;
}

std::string format_tum(const Trajectory& trajectory) {
  trajectory.validate();
  if (!trajectory.has_times() && !trajectory.poses.empty()) {
    throw std::invalid_argument("Trajectory.times is empty, must be one per pose for a TUM file");
  }
  std::string text;
  for (std::size_t k = 0; k < trajectory.poses.size(); ++k) {
    text += tum_line(trajectory.times[k], trajectory.poses[k]);
  }
  return text;
}

}  // namespace oneac
