// For each solver: solutions and valid solutions per call, share of scenes whose true motion is
// among them, time. "generic" scenes are those of the tests; "near-degenerate" ones move by a
// hundredth of the usual length. A call of a batch row solves all scenes.

#include "oneac/geometry/angular_errors.h"
#include "oneac/geometry/essential.h"
#include "oneac/solvers/batch.h"
#include "oneac/solvers/essential_5pc.h"
#include "oneac/solvers/essential_8pc.h"
#include "oneac/solvers/homography_2ac.h"
#include "oneac/solvers/homography_4pc.h"
#include "oneac/solvers/homography_decomposition.h"
#include "oneac/solvers/relpose_1ac_front_wall.h"
#include "oneac/solvers/relpose_1ac_ground.h"
#include "oneac/solvers/relpose_1ac_planar.h"
#include "oneac/solvers/relpose_1ac_planar_pitch.h"
#include "oneac/solvers/relpose_1ac_side_wall.h"
#include "oneac/solvers/relpose_1ac_wall.h"
#include "oneac/solvers/relpose_1pc_ackermann.h"
#include "oneac/solvers/relpose_2pc_ground.h"
#include "oneac/solvers/relpose_2pc_planar.h"
#include "oneac/solvers/relpose_3pc_vertical.h"
#include "oneac/test_support/scenes.h"

#include <benchmark/benchmark.h>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#ifdef ONEAC_HAVE_OPENGV
#include <opengv/relative_pose/CentralRelativeAdapter.hpp>
#include <opengv/relative_pose/methods.hpp>
#endif

namespace {

using namespace oneac;

constexpr int kScenes = 1000;
constexpr double kFound = 1e-6;  // [rad] or [-]: the truth is among the solutions

enum class Scenes { kGeneric, kNearDegenerate, kNoisy };
enum class Motion { kPlanar, kPitched, kCircular, kGeneral };
enum class Surface { kGround, kSide, kFront, kWall, kPlane, kAny };

struct Problem {
  RelativePose T;
  Plane plane;
  std::vector<AffineCorrespondence> acs;
};

RelativePose motion(SceneGenerator& scene, Motion kind) {
  if (kind == Motion::kGeneral) return scene.general_motion();
  RelativePose T = scene.planar_motion();
  if (kind == Motion::kCircular) {
    const double half = 0.5 * std::atan2(T.R(2, 0), T.R(0, 0));
    T.t = T.t.norm() * Eigen::Vector3d(std::sin(half), 0.0, -std::cos(half));
  }
  if (kind == Motion::kPitched) {
    const Eigen::Matrix3d Q = pitch_rotation(scene.uniform(-0.05, 0.05));
    T = {Q.transpose() * T.R, Q.transpose() * T.t};
  }
  return T;
}

Plane surface(SceneGenerator& scene, Surface kind) {
  switch (kind) {
    case Surface::kGround:
      return scene.ground();
    case Surface::kSide:
      return {Eigen::Vector3d::UnitX(), scene.uniform(2, 6)};
    case Surface::kFront:
      return {Eigen::Vector3d::UnitZ(), scene.uniform(4, 20)};
    case Surface::kWall: {
      const double delta = scene.uniform(0.5, 2.6);
      return {{std::cos(delta), 0.0, std::sin(delta)}, scene.uniform(3, 15)};
    }
    default:
      return scene.any_plane();
  }
}

struct Setup {
  Motion motion;
  Surface surface;
  std::size_t count;
};

std::vector<Problem> problems(const Setup& setup, Scenes scenes) {
  SceneGenerator scene(42);
  std::vector<Problem> list;
  for (int i = 0; i < kScenes; ++i) {
    Problem p{motion(scene, setup.motion), surface(scene, setup.surface), {}};
    if (scenes == Scenes::kNearDegenerate) p.T.t *= 0.01;
    while (p.acs.size() < setup.count) {
      const bool own_plane = setup.surface == Surface::kAny;
      const auto ac = scene.on_plane(p.T, own_plane ? scene.any_plane() : p.plane);
      if (!(ac.x1.cwiseAbs().minCoeff() > 0.02)) continue;
      p.acs.push_back(scenes == Scenes::kNoisy ? scene.with_noise(ac, 1e-3, 2e-2) : ac);
    }
    list.push_back(p);
  }
  return list;
}

double error(const RelativePose& pose, const RelativePose& T) {
  return std::max(rotation_error(pose.R, T.R), direction_error(pose.t, T.t));
}

double error_of(const PlanarPose& s, const Problem& p) {
  return error(s.pose(), p.T);
}
double error_of(const PitchedPose& s, const Problem& p) {
  return error(s.pose(), p.T);
}
double error_of(const PlanePose& s, const Problem& p) {
  return error(s.pose(), p.T);
}
/// H (middle singular value one) and E (any scale and sign) are told apart by their determinants.
double error_of(const Eigen::Matrix3d& M, const Problem& p) {
  if (std::abs(M.determinant()) > 1e-3) {
    return (M - plane_induced_homography(p.T, p.plane)).norm();
  }
  const Eigen::Matrix3d E = essential_matrix(p.T).normalized();
  const Eigen::Matrix3d N = M.normalized();
  return std::min(
      {(N - E).norm(), (N + E).norm(), (N.transpose() - E).norm(), (N.transpose() + E).norm()});
}

bool valid(const PlanarPose& s) {
  return s.pose().is_finite();
}
bool valid(const PitchedPose& s) {
  return s.pose().is_finite();
}
bool valid(const PlanePose& s) {
  return s.pose().is_finite();
}
bool valid(const Eigen::Matrix3d& s) {
  return s.allFinite();
}

template <class Solve>
void run(benchmark::State& state, const Setup& setup, Scenes scenes, Solve solve) {
  const std::vector<Problem> list = problems(setup, scenes);
  std::size_t next = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(solve(AcSpan(list[next].acs)));
    next = next + 1 == list.size() ? 0 : next + 1;
  }
  double solutions = 0.0, valid_ones = 0.0, found = 0.0;
  for (const Problem& p : list) {
    double least = 10.0;
    for (const auto& solution : solve(AcSpan(p.acs))) {
      solutions += 1.0;
      valid_ones += valid(solution) ? 1.0 : 0.0;
      least = std::min(least, error_of(solution, p));
    }
    found += least < kFound ? 1.0 : 0.0;
  }
  state.counters["solutions"] = solutions / kScenes;
  state.counters["valid"] = valid_ones / kScenes;
  state.counters["gt_found_pct"] = 100.0 * found / kScenes;
}

template <class Solve>
void add(const std::string& name, const Setup& setup, Solve solve) {
  constexpr const char* kNames[] = {"/generic", "/near-degenerate", "/noisy"};
  for (const Scenes scenes : {Scenes::kGeneric, Scenes::kNearDegenerate, Scenes::kNoisy}) {
    benchmark::RegisterBenchmark(
        (name + kNames[static_cast<int>(scenes)]).c_str(),
        [setup, scenes, solve](benchmark::State& state) { run(state, setup, scenes, solve); });
  }
}

void add_one_ac() {
  add("relpose_1ac_ground", {Motion::kPlanar, Surface::kGround, 1},
      [](AcSpan s) { return relpose_1ac_ground(s[0]); });
  add("relpose_1ac_ground_rapid", {Motion::kPlanar, Surface::kGround, 1},
      [](AcSpan s) { return relpose_1ac_ground_rapid(s[0]); });
  add("relpose_1ac_side_wall", {Motion::kPlanar, Surface::kSide, 1},
      [](AcSpan s) { return relpose_1ac_side_wall(s[0]); });
  add("relpose_1ac_side_wall_rapid", {Motion::kPlanar, Surface::kSide, 1},
      [](AcSpan s) { return relpose_1ac_side_wall_rapid(s[0]); });
  add("relpose_1ac_front_wall", {Motion::kPlanar, Surface::kFront, 1},
      [](AcSpan s) { return relpose_1ac_front_wall(s[0]); });
  add("relpose_1ac_front_wall_rapid", {Motion::kPlanar, Surface::kFront, 1},
      [](AcSpan s) { return relpose_1ac_front_wall_rapid(s[0]); });
  add("relpose_1ac_wall", {Motion::kPlanar, Surface::kWall, 1},
      [](AcSpan s) { return relpose_1ac_wall(s[0]); });
  add("relpose_1ac_wall_candidates", {Motion::kPlanar, Surface::kWall, 1},
      [](AcSpan s) { return relpose_1ac_wall_candidates(s[0]); });
  add("relpose_1ac_planar", {Motion::kPlanar, Surface::kAny, 1},
      [](AcSpan s) { return relpose_1ac_planar(s[0]); });
  add("relpose_1ac_planar_pitch", {Motion::kPitched, Surface::kAny, 1},
      [](AcSpan s) { return relpose_1ac_planar_pitch(s[0]); });
  add("relpose_1ac_planar_pitch(5deg)", {Motion::kPitched, Surface::kAny, 1},
      [](AcSpan s) { return relpose_1ac_planar_pitch(s[0], 0.0873); });
}

using Batch = std::size_t (*)(const AcArrays&, const PlanarPoseArrays&, SimdLevel);

/// All scenes at a time; `s_per_ac` is comparable with the time of the scalar rows.
void run_batch(benchmark::State& state, const Setup& setup, Scenes scenes, Batch solve,
               SimdLevel level) {
  const std::vector<Problem> list = problems(setup, scenes);
  std::vector<double> in[8], out[4];
  for (const Problem& p : list) {
    const AffineCorrespondence& ac = p.acs[0];
    const double values[8] = {ac.x1.x(),  ac.x1.y(),  ac.x2.x(),  ac.x2.y(),
                              ac.A(0, 0), ac.A(0, 1), ac.A(1, 0), ac.A(1, 1)};
    for (int k = 0; k < 8; ++k) in[k].push_back(values[k]);
  }
  for (auto& entry : out) entry.resize(list.size());
  std::vector<std::uint8_t> valid(list.size());
  const AcArrays acs{in[0].data(), in[1].data(), in[2].data(), in[3].data(), in[4].data(),
                     in[5].data(), in[6].data(), in[7].data(), list.size()};
  const PlanarPoseArrays poses{out[0].data(), out[1].data(), out[2].data(), out[3].data(),
                               valid.data()};
  std::size_t solved = 0;
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(solved = solve(acs, poses, level));
  double found = 0.0;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const PlanarPose pose{out[0][i], out[1][i], out[2][i], out[3][i]};
    found += valid[i] != 0 && error_of(pose, list[i]) < kFound ? 1.0 : 0.0;
  }
  state.counters["s_per_ac"] = benchmark::Counter(
      kScenes, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.counters["solutions"] = state.counters["valid"] = static_cast<double>(solved) / kScenes;
  state.counters["gt_found_pct"] = 100.0 * found / kScenes;
}

void add_batch(const std::string& name, const Setup& setup, Batch solve) {
  constexpr const char* kLevels[] = {"/baseline", "/avx2", "/avx512"};
  constexpr const char* kNames[] = {"/generic", "/near-degenerate", "/noisy"};
  for (const SimdLevel level : {SimdLevel::kBaseline, SimdLevel::kAvx2, SimdLevel::kAvx512}) {
    if (!is_supported(level)) continue;
    for (const Scenes scenes : {Scenes::kGeneric, Scenes::kNearDegenerate, Scenes::kNoisy}) {
      const std::string row =
          name + kLevels[static_cast<int>(level)] + kNames[static_cast<int>(scenes)];
      benchmark::RegisterBenchmark(row.c_str(), [=](benchmark::State& state) {
        run_batch(state, setup, scenes, solve, level);
      });
    }
  }
}

void add_batches() {
  add_batch("relpose_1ac_ground_batch", {Motion::kPlanar, Surface::kGround, 1},
            &relpose_1ac_ground_batch);
  add_batch("relpose_1ac_planar_batch", {Motion::kPlanar, Surface::kAny, 1},
            &relpose_1ac_planar_batch);
}

void add_rivals() {
  add("relpose_1pc_ackermann", {Motion::kCircular, Surface::kAny, 1},
      [](AcSpan s) { return relpose_1pc_ackermann(s); });
  add("relpose_2pc_ground", {Motion::kPlanar, Surface::kGround, 2},
      [](AcSpan s) { return relpose_2pc_ground(s); });
  add("relpose_2pc_planar", {Motion::kPlanar, Surface::kAny, 2},
      [](AcSpan s) { return relpose_2pc_planar(s); });
  add("relpose_3pc_vertical", {Motion::kPlanar, Surface::kWall, 3},
      [](AcSpan s) { return relpose_3pc_vertical(s); });
  add("homography_2ac", {Motion::kGeneral, Surface::kPlane, 2},
      [](AcSpan s) { return homography_2ac(s); });
  add("homography_4pc", {Motion::kGeneral, Surface::kPlane, 4},
      [](AcSpan s) { return homography_4pc(s); });
  add("homography_4pc+poses", {Motion::kGeneral, Surface::kPlane, 4}, [](AcSpan s) {
    const auto H = homography_4pc(s);
    return H.empty() ? SolutionSet<PlanePose, 2>() : poses_from_homography(H[0], s);
  });
  add("essential_5pc", {Motion::kGeneral, Surface::kAny, 5},
      [](AcSpan s) { return essential_5pc(s); });
  add("essential_5pc(planar motion)", {Motion::kPlanar, Surface::kAny, 5},
      [](AcSpan s) { return essential_5pc(s); });
  add("essential_8pc", {Motion::kGeneral, Surface::kAny, 8},
      [](AcSpan s) { return essential_8pc(s); });
}

Eigen::Matrix3d to_eigen(const cv::Mat& M, int first_row = 0) {
  Eigen::Matrix3d result;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) result(i, j) = M.at<double>(first_row + i, j);
  }
  return result;
}

/// OpenCV's homography, scaled and signed as ours.
std::vector<Eigen::Matrix3d> scaled(const cv::Mat& M, AcSpan points) {
  if (M.empty()) return {};
  Eigen::Matrix3d H = to_eigen(M);
  H /= H.jacobiSvd().singularValues()(1);
  const double sign = points[0].x2.homogeneous().dot(H * points[0].x1.homogeneous());
  if (sign < 0.0) H = -H;
  return {H};
}

/// Points of both views in OpenCV's types; float where nothing else is taken.
template <class Point>
struct CvPoints {
  std::vector<Point> first, second;

  explicit CvPoints(AcSpan acs) {
    using Scalar = decltype(Point::x);
    for (const auto& ac : acs) {
      first.emplace_back(static_cast<Scalar>(ac.x1.x()), static_cast<Scalar>(ac.x1.y()));
      second.emplace_back(static_cast<Scalar>(ac.x2.x()), static_cast<Scalar>(ac.x2.y()));
    }
  }
};

/// Conversion to OpenCV's types is part of the time, as it would be for a caller of ours. OpenCV
/// stores the points of homographies and of the eight-point method in single precision: below
/// kFound the ground truth is found in part of the scenes only.
void add_opencv() {
  add("OpenCV/findHomography(0)", {Motion::kGeneral, Surface::kPlane, 4}, [](AcSpan s) {
    const CvPoints<cv::Point2d> p(s);
    return scaled(cv::findHomography(p.first, p.second, 0), s);
  });
  add("OpenCV/getPerspectiveTransform", {Motion::kGeneral, Surface::kPlane, 4}, [](AcSpan s) {
    const CvPoints<cv::Point2f> p(s);
    return scaled(cv::getPerspectiveTransform(p.first.data(), p.second.data()), s);
  });
  add("OpenCV/findHomography(0)+decomposeHomographyMat", {Motion::kGeneral, Surface::kPlane, 4},
      [](AcSpan s) {
        const CvPoints<cv::Point2d> p(s);
        const cv::Mat H = cv::findHomography(p.first, p.second, 0);
        std::vector<PlanePose> poses;
        std::vector<cv::Mat> R, t, n;
        if (!H.empty()) cv::decomposeHomographyMat(H, cv::Mat::eye(3, 3, CV_64F), R, t, n);
        for (std::size_t i = 0; i < R.size(); ++i) {
          const auto vector = [](const cv::Mat& v) {
            return Eigen::Vector3d(v.at<double>(0), v.at<double>(1), v.at<double>(2));
          };
          poses.push_back({{to_eigen(R[i]), vector(t[i])}, vector(n[i])});
        }
        return poses;
      });
  add("OpenCV/findEssentialMat(5, RANSAC)", {Motion::kGeneral, Surface::kAny, 5}, [](AcSpan s) {
    const CvPoints<cv::Point2d> p(s);  // five points: its minimal solver, called once
    const cv::Mat E = cv::findEssentialMat(p.first, p.second, cv::Mat::eye(3, 3, CV_64F),
                                           cv::RANSAC, 0.999, 1e-3);
    std::vector<Eigen::Matrix3d> all;
    for (int row = 0; row + 3 <= E.rows; row += 3) all.push_back(to_eigen(E, row));
    return all;
  });
  add("OpenCV/findFundamentalMat(8POINT)", {Motion::kGeneral, Surface::kAny, 8}, [](AcSpan s) {
    const CvPoints<cv::Point2d> p(s);
    const cv::Mat F = cv::findFundamentalMat(p.first, p.second, cv::FM_8POINT);
    return F.empty() ? std::vector<Eigen::Matrix3d>() : std::vector<Eigen::Matrix3d>{to_eigen(F)};
  });
}

#ifdef ONEAC_HAVE_OPENGV
template <class Method>
auto with_opengv(AcSpan acs, Method method) {
  opengv::bearingVectors_t first, second;
  for (const auto& ac : acs) {
    first.push_back(ac.x1.homogeneous().normalized());
    second.push_back(ac.x2.homogeneous().normalized());
  }
  opengv::relative_pose::CentralRelativeAdapter adapter(first, second);
  return method(adapter);
}

void add_opengv() {
  using opengv::relative_pose::CentralRelativeAdapter;
  add("OpenGV/fivept_nister", {Motion::kGeneral, Surface::kAny, 5}, [](AcSpan s) {
    return with_opengv(
        s, [](CentralRelativeAdapter& a) { return opengv::relative_pose::fivept_nister(a); });
  });
  add("OpenGV/fivept_stewenius", {Motion::kGeneral, Surface::kAny, 5}, [](AcSpan s) {
    return with_opengv(s, [](CentralRelativeAdapter& a) {
      opengv::essentials_t real;
      for (const auto& E : opengv::relative_pose::fivept_stewenius(a)) {
        if (E.imag().norm() < 1e-9 * E.real().norm()) real.push_back(E.real());
      }
      return real;
    });
  });
  add("OpenGV/eightpt", {Motion::kGeneral, Surface::kAny, 8}, [](AcSpan s) {
    return with_opengv(s, [](CentralRelativeAdapter& a) {
      return opengv::essentials_t{opengv::relative_pose::eightpt(a)};
    });
  });
}
#endif

}  // namespace

int main(int argc, char** argv) {
  add_one_ac();
  add_batches();
  add_rivals();
  cv::setNumThreads(1);
  add_opencv();
#ifdef ONEAC_HAVE_OPENGV
  add_opengv();
#endif
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
