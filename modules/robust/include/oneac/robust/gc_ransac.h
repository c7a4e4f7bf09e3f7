#pragma once

#include "oneac/base/bound.h"
#include "oneac/robust/robust_result.h"
#include "oneac/solvers/span.h"

#include <cstdint>
#include <string>

namespace oneac {

struct Solver;

/// Graph-cut RANSAC. validate() throws std::invalid_argument naming field, value and bound.
/// Defaults without a word of their own: docs/decisions/gc-ransac.md.
struct GcRansacOptions {
  double threshold_px = 1.0;  ///< [px] Sampson inlier bound; DoG points repeat to 0.3…0.5 px
  double confidence = 0.99;   ///< probability of having drawn a sample without outlier
  int max_iterations = 5000;  ///< minimal samples at most
  int min_iterations = 50;    ///< minimal samples at least
  std::string sampler = "uniform";  ///< uniform | prosac (correspondences come best first)
  int neighbourhood_cells = 8;      ///< grid cells per image axis; the authors' program has 8
  double coherence = 0.14;          ///< λ of the energy; 0.14 in the paper, 0: no graph cut
  int lo_iterations = 10;           ///< cuts and refits of one local optimisation at most; 0: none
  std::string lo_model = "both";    ///< refits: 8pc | polish (five degrees of freedom) | both
  int min_inliers = 15;             ///< fewer support nothing: five unknowns, three times over

  /// @throws std::invalid_argument naming field, value and bound
  void validate() const;
};

template <class Visitor>
void describe(Visitor&& visit, GcRansacOptions& o) {
  visit("threshold_px", o.threshold_px, "px", "Sampson inlier bound", Bound::positive());
  visit("confidence", o.confidence, "-", "probability of a sample without outlier",
        Bound::between(0, 1));
  visit("max_iterations", o.max_iterations, "count", "minimal samples at most", Bound::at_least(1));
  visit("min_iterations", o.min_iterations, "count", "minimal samples at least",
        Bound::at_least(1));
  visit("sampler", o.sampler, "name", "uniform or prosac (best correspondences first)",
        Bound::one_of("uniform or prosac"));
  visit("neighbourhood_cells", o.neighbourhood_cells, "count", "grid cells per image axis",
        Bound::from_to(1, 1000));
  visit("coherence", o.coherence, "-", "weight of the neighbours in the graph cut; 0: none",
        Bound::from_to(0, 1e6));
  visit("lo_iterations", o.lo_iterations, "count", "refits of one local optimisation; 0: none",
        Bound::at_least(0));
  visit("lo_model", o.lo_model, "name", "refits: 8pc, polish or both",
        Bound::one_of("both, polish or 8pc"));
  visit("min_inliers", o.min_inliers, "count", "a pose with fewer is refused", Bound::at_least(5));
}

/// Relative pose by Graph-Cut RANSAC (Barath and Matas, CVPR 2018) with any minimal solver inside.
///
/// Every model is verified as an essential matrix, MSAC on the Sampson distance, also those that
/// come from a homography. A new best minimal model is optimised locally: graph cut, refit on its
/// inliers, as long as that helps. The end is a five-degree-of-freedom polishing on all points and
/// the sign of t by cheirality. Same input, seed and options give the same bits.
/// @param acs          normalised correspondences of the (tilted) camera; best first for "prosac".
///                     Those that are not finite take no part
/// @param R_level_cam  removes the camera's tilt (geometry/levelling.h) for planar solvers
/// @param focal_px     what turns threshold_px into normalised units [px]
/// @return             kOk or kTooFew (identity); standing cameras and planes are not looked for
/// @throws std::invalid_argument for options or a focal length out of bounds
[[nodiscard]] RobustResult gc_ransac(AcSpan acs, const Eigen::Matrix3d& R_level_cam,
                                     double focal_px, const Solver& solver, std::uint64_t seed,
                                     const GcRansacOptions& options);

}  // namespace oneac
