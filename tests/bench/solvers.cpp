// For each solver of the list and its rivals: solutions and valid solutions per call, share of
// scenes whose true motion is among them, time. "generic" scenes are those of the tests;
// "near-degenerate" ones move by a hundredth of the usual length. A call of a batch row solves all
// scenes.

#include "oneac/geometry/angular_errors.h"
#include "oneac/geometry/essential.h"
#include "oneac/solvers/relpose_1ac_planar_pitch.h"
#include "oneac/test_support/solver_scenes.h"

#include <benchmark/benchmark.h>

#include <Eigen/Geometry>
#include <Eigen/SVD>
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
struct Problem {
  RelativePose T;
  Plane plane;
  std::vector<AffineCorrespondence> acs;
};

/// Scenes that the solver is made for.
std::vector<Problem> problems(const Solver& solver, Scenes scenes) {
  SceneGenerator scene(42);
  std::vector<Problem> list;
  for (int i = 0; i < kScenes; ++i) {
    Problem p{test::motion_of(solver, scene), test::plane_of(solver, scene), {}};
    if (scenes == Scenes::kNearDegenerate) p.T.t *= 0.01;
    p.acs = test::correspondences_of(solver, scene, p.T, p.plane);
    if (scenes == Scenes::kNoisy) {
      for (auto& ac : p.acs) ac = scene.with_noise(ac, 1e-3, 2e-2);
    }
    list.push_back(p);
  }
  return list;
}

double error(const RelativePose& pose, const RelativePose& T) {
  return std::max(rotation_error(pose.R, T.R), direction_error(pose.t, T.t));
}

template <class Solution>
double error_of(const Solution& s, const Problem& p) {
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

template <class Solution>
bool valid(const Solution& s) {
  return s.pose().is_finite();
}
bool valid(const Eigen::Matrix3d& s) {
  return s.allFinite();
}

/// Times `timed` and judges the solutions that `solve` gives.
template <class Timed, class Solve>
void run(benchmark::State& state, const std::vector<Problem>& list, Timed timed, Solve solve) {
  std::size_t next = 0;
  for ([[maybe_unused]] auto _ : state) {
    benchmark::DoNotOptimize(timed(AcSpan(list[next].acs)));
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

template <class Timed, class Solve>
void add(const std::string& name, const Solver& made_for, Timed timed, Solve solve) {
  constexpr const char* kNames[] = {"/generic", "/near-degenerate", "/noisy"};
  for (const Scenes scenes : {Scenes::kGeneric, Scenes::kNearDegenerate, Scenes::kNoisy}) {
    benchmark::RegisterBenchmark(
        (name + kNames[static_cast<int>(scenes)]).c_str(),
        [=](benchmark::State& state) { run(state, problems(made_for, scenes), timed, solve); });
  }
}

/// A rival of the solver of that name.
template <class Solve>
void add_rival(const std::string& name, std::string_view of, Solve solve) {
  add(name, solver_named(of), solve, solve);
}

/// The bare solvers are timed; the poses that follow from their matrices are judged.
void add_solvers() {
  for (const Solver& solver : solvers()) {
    add(std::string(solver.name), solver, solver.run.count, solver.run.poses);
  }
  add_rival("relpose_1ac_planar_pitch(any)", "relpose_1ac_planar_pitch",
            [](AcSpan s) { return relpose_1ac_planar_pitch(s[0]); });
  const auto& homography = solver_named("homography_4pc");
  add_rival("homography_4pc+poses", "homography_4pc", homography.run.poses);
  Solver five = solver_named("essential_5pc");
  five.motion = SolverMotion::kPlanar;
  add("essential_5pc(planar motion)", five, five.run.count, five.run.poses);
}

/// All scenes at a time; `s_per_ac` is comparable with the time of the scalar rows.
void run_batch(benchmark::State& state, const Solver& solver, Scenes scenes, SimdLevel level) {
  const std::vector<Problem> list = problems(solver, scenes);
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
  for ([[maybe_unused]] auto _ : state)
    benchmark::DoNotOptimize(solved = solver.batch(acs, poses, level));
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

void add_batch(const Solver& solver) {
  const std::string name = std::string(solver.name) + "_batch";
  constexpr const char* kLevels[] = {"/baseline", "/avx2", "/avx512"};
  constexpr const char* kNames[] = {"/generic", "/near-degenerate", "/noisy"};
  for (const SimdLevel level : {SimdLevel::kBaseline, SimdLevel::kAvx2, SimdLevel::kAvx512}) {
    if (!is_supported(level)) continue;
    for (const Scenes scenes : {Scenes::kGeneric, Scenes::kNearDegenerate, Scenes::kNoisy}) {
      const std::string row =
          name + kLevels[static_cast<int>(level)] + kNames[static_cast<int>(scenes)];
      benchmark::RegisterBenchmark(row.c_str(), [=, &solver](benchmark::State& state) {
        run_batch(state, solver, scenes, level);
      });
    }
  }
}

void add_batches() {
  for (const Solver& solver : solvers()) {
    if (solver.batch != nullptr) add_batch(solver);
  }
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
  add_rival("OpenCV/findHomography(0)", "homography_4pc", [](AcSpan s) {
    const CvPoints<cv::Point2d> p(s);
    return scaled(cv::findHomography(p.first, p.second, 0), s);
  });
  add_rival("OpenCV/getPerspectiveTransform", "homography_4pc", [](AcSpan s) {
    const CvPoints<cv::Point2f> p(s);
    return scaled(cv::getPerspectiveTransform(p.first.data(), p.second.data()), s);
  });
  add_rival("OpenCV/findHomography(0)+decomposeHomographyMat", "homography_4pc", [](AcSpan s) {
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
  add_rival("OpenCV/findEssentialMat(5, RANSAC)", "essential_5pc", [](AcSpan s) {
    const CvPoints<cv::Point2d> p(s);  // five points: its minimal solver, called once
    const cv::Mat E = cv::findEssentialMat(p.first, p.second, cv::Mat::eye(3, 3, CV_64F),
                                           cv::RANSAC, 0.999, 1e-3);
    std::vector<Eigen::Matrix3d> all;
    for (int row = 0; row + 3 <= E.rows; row += 3) all.push_back(to_eigen(E, row));
    return all;
  });
  add_rival("OpenCV/findFundamentalMat(8POINT)", "essential_8pc", [](AcSpan s) {
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
  add_rival("OpenGV/fivept_nister", "essential_5pc", [](AcSpan s) {
    return with_opengv(
        s, [](CentralRelativeAdapter& a) { return opengv::relative_pose::fivept_nister(a); });
  });
  add_rival("OpenGV/fivept_stewenius", "essential_5pc", [](AcSpan s) {
    return with_opengv(s, [](CentralRelativeAdapter& a) {
      opengv::essentials_t real;
      for (const auto& E : opengv::relative_pose::fivept_stewenius(a)) {
        if (E.imag().norm() < 1e-9 * E.real().norm()) real.push_back(E.real());
      }
      return real;
    });
  });
  add_rival("OpenGV/eightpt", "essential_8pc", [](AcSpan s) {
    return with_opengv(s, [](CentralRelativeAdapter& a) {
      return opengv::essentials_t{opengv::relative_pose::eightpt(a)};
    });
  });
}
#endif

}  // namespace

int main(int argc, char** argv) {
  add_solvers();
  add_batches();
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
