#include "oneac/robust/gc_ransac_homography.h"

#include "gc_ransac_loop.h"

#include "oneac/base/require.h"
#include "oneac/solvers/homography_2ac.h"
#include "oneac/solvers/homography_4pc.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace oneac {
namespace {

using internal::FiniteAcs;

double squared_transfer_error(const Eigen::Matrix3d& H, const AffineCorrespondence& ac) {
  const Eigen::Vector3d y = H * ac.x1.homogeneous();
  if (!(y.z() > 0.0)) return std::numeric_limits<double>::infinity();  // behind the camera
  return (y.head<2>() / y.z() - ac.x2).squaredNorm();
}

class HomographySpace : public internal::ModelSpace {
 public:
  HomographySpace(AcSpan acs, HomographyMethod method, double threshold)
      : acs_(acs), affine_(method == HomographyMethod::k2ac), squared_(threshold * threshold) {
    gathered_.reserve(acs.size());
  }

  AcSpan points() const override { return acs_; }
  std::size_t sample_size() const override { return affine_ ? 2 : 4; }
  bool approximate() const override { return false; }

  EssentialSet solve(const std::size_t* sample) override {
    AffineCorrespondence drawn[kLargestSample];
    for (std::size_t i = 0; i < sample_size(); ++i) drawn[i] = acs_[sample[i]];
    EssentialSet models;
    for (const Eigen::Matrix3d& H : fit({drawn, sample_size()})) models.push_back(H);
    return models;
  }

  double cost(const Eigen::Matrix3d& H, double give_up) override {
    double sum = 0.0;
    for (std::size_t i = 0; i < acs_.size() && sum < give_up; ++i) {
      sum += std::min(squared_transfer_error(H, acs_[i]) / squared_, 1.0);
    }
    return sum;
  }

  void squared_errors(const Eigen::Matrix3d& H, std::vector<double>& errors) override {
    errors.resize(acs_.size());
    for (std::size_t i = 0; i < acs_.size(); ++i) {
      errors[i] = squared_transfer_error(H, acs_[i]) / squared_;
    }
  }

  bool refit(int /*way*/, const std::vector<std::uint8_t>& labels, Eigen::Matrix3d& H) override {
    const auto fitted = fit(internal::gather(acs_, labels, gathered_));
    if (fitted.empty()) return false;
    H = fitted[0];
    return true;
  }

 private:
  SolutionSet<Eigen::Matrix3d, 1> fit(AcSpan acs) const {
    return affine_ ? homography_2ac(acs) : homography_4pc(acs);
  }

  AcSpan acs_;
  bool affine_;
  double squared_;
  std::vector<AffineCorrespondence> gathered_;
};

}  // namespace

RobustHomography fit_homography(AcSpan acs, double threshold, HomographyMethod method,
                                std::uint64_t seed, const GcRansacOptions& options) {
  options.validate();
  require(threshold > 0.0, "fit_homography: threshold", threshold, "positive");
  RobustHomography result;
  result.inliers.assign(acs.size(), false);
  result.cost = static_cast<double>(acs.size());
  const FiniteAcs finite(acs);
  HomographySpace space(finite.acs, method, threshold);
  const internal::LoopResult found = internal::gc_ransac_loop(space, seed, options);
  result.statistics = found.statistics;
  if (!found.found) return result;
  std::vector<double> errors;
  space.squared_errors(found.model, errors);
  result.H = found.model;
  result.cost = found.cost + static_cast<double>(acs.size() - finite.acs.size());
  result.inlier_count = internal::flag_inliers(finite, errors, result.inliers);
  result.found = result.inlier_count >= static_cast<std::size_t>(options.min_inliers);
  return result;
}

}  // namespace oneac
