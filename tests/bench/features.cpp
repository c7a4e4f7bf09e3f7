// What affine correspondences cost and what they are worth: CPU time per image of each extractor in
// the same run and, where true poses are given, the share of correspondences whose single
// hypothesis (the best of the one-AC solvers) is near the true motion.
//
//   oneac_bench_features IMAGES [--every K] [--count N] [--extractors a,b] [--dump PREFIX]
//                        [--poses FILE --camera FX,CX,CY --height H [--pitch-up DEG]]
//
// IMAGES is a folder (its pictures in the order of their names) or a text file with a path a line.

#include "oneac/base/thread_clock.h"
#include "oneac/features/ac_tracker.h"
#include "oneac/features/feature_options.h"
#include "oneac/geometry/angular_errors.h"
#include "oneac/geometry/homography.h"
#include "oneac/geometry/levelling.h"
#include "oneac/solvers/registry.h"

#include <Eigen/LU>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using namespace oneac;

constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr double kMoving = 0.1;  // [m] shorter steps have no direction to judge
/// Thresholds of the curve: rotation and direction [deg].
constexpr std::array<std::pair<double, double>, 6> kCurve = {
    {{0.1, 1.0}, {0.2, 2.0}, {0.5, 5.0}, {1.0, 10.0}, {2.0, 20.0}, {5.0, 45.0}}};

struct Settings {
  std::string images, poses, dump;
  std::vector<std::string> extractors = {"klt", "vlfeat", "vlfeat+align", "sift"};
  std::size_t every = 1, count = 0;
  PinholeCamera camera;
  double height = 0.0;  // [m]
  Tilt tilt;
};

/// What one extractor did.
struct Tally {
  std::vector<double> prepare_ms, advance_ms, acs;
  std::array<std::size_t, kCurve.size()> within{};
  std::size_t judged = 0;
};

std::vector<std::string> split(const std::string& text, char by) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, by);) parts.push_back(part);
  return parts;
}

Settings read_settings(const std::vector<std::string>& words) {
  if (words.empty()) throw std::invalid_argument("give a folder or a list of images");
  Settings s;
  s.images = words[0];
  for (std::size_t i = 1; i + 1 < words.size(); i += 2) {
    const std::string &key = words[i], &value = words[i + 1];
    if (key == "--every") {
      s.every = std::stoul(value);
    } else if (key == "--count") {
      s.count = std::stoul(value);
    } else if (key == "--extractors") {
      s.extractors = split(value, ',');
    } else if (key == "--dump") {
      s.dump = value;
    } else if (key == "--poses") {
      s.poses = value;
    } else if (key == "--height") {
      s.height = std::stod(value);
    } else if (key == "--pitch-up") {
      s.tilt.pitch_up = std::stod(value) * kDegree;
    } else if (key == "--camera") {
      const auto numbers = split(value, ',');
      s.camera.fx = s.camera.fy = std::stod(numbers.at(0));
      s.camera.cx = std::stod(numbers.at(1));
      s.camera.cy = std::stod(numbers.at(2));
    } else {
      throw std::invalid_argument("unknown flag " + key);
    }
  }
  return s;
}

std::vector<std::string> image_paths(const std::string& source) {
  std::vector<std::string> paths;
  if (std::filesystem::is_directory(source)) {
    for (const auto& entry : std::filesystem::directory_iterator(source)) {
      paths.push_back(entry.path().string());
    }
    std::sort(paths.begin(), paths.end());
  } else {
    std::ifstream in(source);
    for (std::string line; std::getline(in, line);) paths.push_back(line);
  }
  return paths;
}

/// T_world_cam of each image, KITTI's format.
std::vector<Eigen::Matrix4d> read_poses(const std::string& path) {
  std::vector<Eigen::Matrix4d> poses;
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    std::istringstream numbers(line);
    Eigen::Matrix4d T = Eigen::Matrix4d::Identity();
    for (int i = 0; i < 12; ++i) numbers >> T(i / 4, i % 4);
    poses.push_back(T);
  }
  return poses;
}

RelativePose relative(const Eigen::Matrix4d& one, const Eigen::Matrix4d& two) {
  const Eigen::Matrix4d T = two.inverse() * one;
  return {T.topLeftCorner<3, 3>(), T.topRightCorner<3, 1>()};
}

/// Every pose that a single correspondence proposes, levelled.
std::vector<RelativePose> hypotheses(const AffineCorrespondence& ac) {
  std::vector<RelativePose> poses;
  for (const Solver& solver : solvers()) {
    if (solver.pool == PoolUse::kNever) continue;
    for (const PlanarPose& solution : solver.run.planar(ac)) poses.push_back(solution.pose());
  }
  return poses;
}

void judge(const TrackedPair& pair, const RelativePose& truth, const Settings& s, Tally& tally) {
  const Eigen::Matrix3d L = levelling_rotation(s.tilt);
  const RelativePose level_truth = level(truth, L);
  for (const auto& ac_px : pair.correspondences) {
    ++tally.judged;
    const auto ac = rotate_views(normalise(ac_px, s.camera, s.camera), L, L);
    if (!ac) continue;
    std::array<bool, kCurve.size()> near{};
    for (const RelativePose& T : hypotheses(*ac)) {
      const double rotation = rotation_error(T.R, level_truth.R) / kDegree;
      const double direction = direction_error(T.t, level_truth.t) / kDegree;
      for (std::size_t k = 0; k < kCurve.size(); ++k) {
        near[k] = near[k] || (rotation <= kCurve[k].first && direction <= kCurve[k].second);
      }
    }
    for (std::size_t k = 0; k < kCurve.size(); ++k) tally.within[k] += near[k] ? 1 : 0;
  }
}

/// Record: index1, index2, count (int32), then x1 y1 x2 y2 a11 a12 a21 a22 (double) each.
void dump(std::ofstream& out, std::size_t one, std::size_t two, const TrackedPair& pair) {
  const std::array<std::int32_t, 3> head = {static_cast<std::int32_t>(one),
                                            static_cast<std::int32_t>(two),
                                            static_cast<std::int32_t>(pair.size())};
  out.write(reinterpret_cast<const char*>(head.data()), sizeof head);
  for (const auto& ac : pair.correspondences) {
    const std::array<double, 8> v = {ac.x1.x(),  ac.x1.y(),  ac.x2.x(),  ac.x2.y(),
                                     ac.A(0, 0), ac.A(0, 1), ac.A(1, 0), ac.A(1, 1)};
    out.write(reinterpret_cast<const char*>(v.data()), sizeof v);
  }
}

/// One extractor with its tracker, so that all of them see each image in turn.
struct Contestant {
  std::string name;
  std::unique_ptr<AcTracker> tracker;
  Tally tally;
  std::ofstream out;
};

std::vector<Contestant> contestants(const Settings& s) {
  std::vector<Contestant> all;
  for (const std::string& name : s.extractors) {
    FeatureOptions options;
    options.extractor = name;
    all.push_back({name, make_tracker(options), {}, {}});
    if (!s.dump.empty()) all.back().out.open(s.dump + name + ".bin", std::ios::binary);
  }
  return all;
}

void run(const Settings& s, std::vector<Contestant>& all) {
  const auto paths = image_paths(s.images);
  const auto poses = s.poses.empty() ? std::vector<Eigen::Matrix4d>{} : read_poses(s.poses);
  MotionHint hint;  // the motion of the pair before: what a front-end knows
  hint.camera = s.camera;
  hint.R_level_cam = levelling_rotation(s.tilt);
  std::size_t last = 0, done = 0;
  for (std::size_t i = 0; i < paths.size() && (s.count == 0 || done < s.count); i += s.every) {
    const cv::Mat image = cv::imread(paths[i], cv::IMREAD_GRAYSCALE);
    if (image.empty()) continue;
    const ImageView view{image.data, image.cols, image.rows, static_cast<int>(image.step)};
    for (Contestant& c : all) {
      const double start = thread_cpu_ms();
      const auto frame = c.tracker->prepare(view);
      const double middle = thread_cpu_ms();
      const TrackedPair pair = c.tracker->advance(frame, hint);
      const double end = thread_cpu_ms();
      if (done == 0) continue;
      c.tally.prepare_ms.push_back(middle - start);
      c.tally.advance_ms.push_back(end - middle);
      c.tally.acs.push_back(static_cast<double>(pair.size()));
      if (c.out.is_open()) dump(c.out, last, i, pair);
      if (i < poses.size()) {
        const RelativePose truth = relative(poses[last], poses[i]);
        if (truth.t.norm() > kMoving) judge(pair, truth, s, c.tally);
      }
    }
    if (done > 0 && i < poses.size() && s.height > 0.0) {
      hint.T_2_1 = relative(poses[last], poses[i]);
      hint.T_2_1->t /= s.height;
      hint.scaled = true;
    }
    last = i;
    ++done;
  }
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void print(const std::vector<Contestant>& all) {
  std::printf(
      "| extractor | prepare [ms] | advance [ms] | sum [ms] | ACs |\n|---|---|---|---|---|\n");
  for (const Contestant& c : all) {
    const double prepare = median(c.tally.prepare_ms), advance = median(c.tally.advance_ms);
    std::printf("| %s | %.2f | %.2f | %.2f | %.0f |\n", c.name.c_str(), prepare, advance,
                prepare + advance, median(c.tally.acs));
  }
  if (all.empty() || all.front().tally.judged == 0) return;
  std::printf(
      "\nShare of correspondences [%%] with a hypothesis within rotation / direction [deg]:\n");
  std::printf("| extractor |");
  for (const auto& [r, d] : kCurve) std::printf(" %g / %g |", r, d);
  std::printf("\n|---|---|---|---|---|---|---|\n");
  for (const Contestant& c : all) {
    std::printf("| %s |", c.name.c_str());
    for (const std::size_t n : c.tally.within) {
      std::printf(" %.1f |", 100.0 * static_cast<double>(n) / static_cast<double>(c.tally.judged));
    }
    std::printf("\n");
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    cv::setNumThreads(1);  // the thread's clock sees all that OpenCV does
    const Settings settings = read_settings({argv + 1, argv + argc});
    auto all = contestants(settings);
    run(settings, all);
    print(all);
    return EXIT_SUCCESS;
  } catch (const std::exception& fault) {
    std::cerr << "oneac_bench_features: " << fault.what() << "\n";
    return 2;
  }
}
