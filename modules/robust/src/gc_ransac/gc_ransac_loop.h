#pragma once

#include "oneac/robust/gc_ransac.h"
#include "oneac/solvers/registry.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace oneac::internal {

/// What the loop estimates: any model that is a 3×3 matrix, with its solver, error and refit.
class ModelSpace {
 public:
  virtual ~ModelSpace() = default;
  ModelSpace(const ModelSpace&) = delete;
  ModelSpace& operator=(const ModelSpace&) = delete;

  /// The correspondences that take part, all finite.
  [[nodiscard]] virtual AcSpan points() const = 0;
  [[nodiscard]] virtual std::size_t sample_size() const = 0;
  /// The solver assumes more than the scene keeps (planar motion, a plane): its models are coarse
  /// even of samples without outlier or noise.
  [[nodiscard]] virtual bool approximate() const = 0;
  /// Models of the sample_size() correspondences of those indices.
  [[nodiscard]] virtual EssentialSet solve(const std::size_t* sample) = 0;
  /// MSAC cost; may stop early and return something ≥ give_up.
  [[nodiscard]] virtual double cost(const Eigen::Matrix3d& model, double give_up) = 0;
  /// r² / threshold² of every point.
  virtual void squared_errors(const Eigen::Matrix3d& model, std::vector<double>& errors) = 0;
  /// Ways to refit; the last one is the best close to the optimum.
  [[nodiscard]] virtual int refits() const { return 1; }
  /// Refits the model to the points with label 1 in one of those ways; false when that cannot be
  /// done.
  [[nodiscard]] virtual bool refit(int way, const std::vector<std::uint8_t>& labels,
                                   Eigen::Matrix3d& model) = 0;

 protected:
  ModelSpace() = default;
};

struct LoopResult {
  bool found = false;
  Eigen::Matrix3d model = Eigen::Matrix3d::Zero();
  double cost = 0.0;
  RobustStatistics statistics;
};

/// Samples that make an outlier-free one of `sample_size` certain to `confidence` when the share
/// `inlier_ratio` of the points are inliers; ≥ 1, infinite for a ratio of zero.
[[nodiscard]] double needed_samples(double inlier_ratio, std::size_t sample_size,
                                    double confidence);

/// The loop: sample, solve, verify, optimise locally, stop when confident.
[[nodiscard]] LoopResult gc_ransac_loop(ModelSpace& space, std::uint64_t seed,
                                        const GcRansacOptions& options);

/// The labelled ones, gathered into a buffer that keeps its memory.
AcSpan gather(AcSpan acs, const std::vector<std::uint8_t>& labels,
              std::vector<AffineCorrespondence>& buffer);

}  // namespace oneac::internal
