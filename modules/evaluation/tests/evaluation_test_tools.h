#pragma once

#include "oneac/base/error.h"
#include "oneac/evaluation/trajectory_io.h"
#include "oneac/test_support/scenes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace oneac {

inline std::filesystem::path write_text(const std::filesystem::path& path,
                                        const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

/// The message of the InputError that `call` throws; a failure when it throws none.
template <class Call>
std::string input_error_of(Call&& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << "no InputError was thrown";
  return {};
}

inline void expect_contains(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is not in: " << text;
}

inline Eigen::Isometry3d pose_at(double x, double y, double z, double yaw = 0.0) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitY()).toRotationMatrix();
  T.translation() << x, y, z;
  return T;
}

/// A camera that drives along Z with a constant step [m].
inline std::vector<Eigen::Isometry3d> straight_drive(int frames, double step) {
  std::vector<Eigen::Isometry3d> poses;
  poses.reserve(static_cast<std::size_t>(frames));
  for (int k = 0; k < frames; ++k) poses.push_back(pose_at(0.0, 0.0, step * k));
  return poses;
}

/// A winding drive of random small motions.
inline std::vector<Eigen::Isometry3d> winding_drive(int frames, std::uint64_t seed) {
  SceneGenerator scenes(seed);
  std::vector<Eigen::Isometry3d> poses{Eigen::Isometry3d::Identity()};
  while (static_cast<int>(poses.size()) < frames) {
    Eigen::Isometry3d step = Eigen::Isometry3d::Identity();
    const RelativePose motion = scenes.general_motion();
    step.linear() = motion.R;
    step.translation() << 0.1 * motion.t.x(), 0.1 * motion.t.y(), std::abs(motion.t.z()) + 0.5;
    poses.push_back(poses.back() * step);
  }
  return poses;
}

}  // namespace oneac
