#pragma once

#include "oneac/geometry/levelling.h"
#include "oneac/geometry/relative_pose.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace oneac {

/// The status of an answer that breaks what initialisers promise: no pose, a failure.
inline constexpr const char* kInvalidAnswer = "invalid";

/// One estimate: one method, one trial, one pair.
struct MethodResult {
  std::size_t method = 0;  ///< index into the methods of the comparison
  int trial = 0;
  std::string status;  ///< of PoseStatus, or kInvalidAnswer
  std::string fault;   ///< what was wrong with an answer that could not be used, else ""
  bool has_pose = false;
  RelativePose pose;  ///< T_2_1 of the camera, |t| = 1 or 0; identity without a pose
  std::size_t inliers = 0;
  std::size_t iterations = 0;
  std::size_t hypotheses = 0;
  std::size_t local_optimisations = 0;
  std::size_t graph_cuts = 0;
  double ms = 0.0;  ///< CPU time of the estimating thread [ms]
};

/// All estimates of one pair of images.
struct PairRecord {
  std::size_t log = 0;      ///< index into the logs of the comparison
  std::size_t ordinal = 0;  ///< number of the pair in its log
  std::size_t index1 = 0;   ///< images of the camera in the log
  std::size_t index2 = 0;
  std::size_t acs = 0;                ///< affine correspondences, the same for every method
  std::optional<RelativePose> truth;  ///< T_2_1 [m]; t = 0 when only the turn is known
  std::vector<MethodResult> results;
};

/// What is known about a log as a whole.
struct LogRecord {
  std::size_t log = 0;
  std::string name;
  std::size_t images = 0;  ///< selected and present
  std::size_t pairs = 0;
  std::size_t last_index = 0;        ///< of the last of these images in the log
  std::string content;               ///< LogScan::content
  Tilt tilt;                         ///< that every method was given
  std::string reference;             ///< "none", "GPS course" or the file of poses
  double course_sigma_deg = 0.0;     ///< 1σ of a GPS course, 0: not from GPS
  double heading_sigma_deg = 0.0;    ///< of the reference turn of a usual pair
  double heading_vs_gyro_deg = 0.0;  ///< root mean square of GPS against gyroscope; 0: no gyroscope
};

/// A comparison, or the part of it that is done.
struct ComparisonData {
  std::vector<std::string> methods;
  int trials = 1;
  std::vector<LogRecord> logs;
  std::vector<PairRecord> pairs;  ///< by log, then ordinal
  std::size_t pairs_planned = 0;  ///< of the logs met so far
};

}  // namespace oneac
