#pragma once

#include "run/run_observer.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace oneac::app {

/// What one pair of images gave.
struct PairFeatures {
  std::size_t index1 = 0, index2 = 0;  ///< images of the camera in the log
  std::size_t acs = 0;
  std::size_t followed = 0;  ///< of them on tracks that the pair before had too
  bool standing = false;
  double motion_px = 0.0;                 ///< median |u2 − u1|
  std::optional<double> affine_residual;  ///< median over the inliers [-], see FeatureStatistics
  double decode_ms = 0.0, features_ms = 0.0;
};

/// Statistics of the correspondences of a drive, pair by pair.
///
/// The affine residual of a correspondence is the length of Aᵀ (E x1)₁₂ + (Eᵀ x2)₁₂ over that of
/// (Eᵀ x2)₁₂, with E of the pair's own pose: what A is off across the epipolar line, as a share.
/// Only correspondences whose points obey E count, and pairs that moved.
class FeatureStatistics {
 public:
  static constexpr int kColumns = 12, kRows = 6;  ///< regions of the image

  /// @param threshold_px  Sampson distance up to which points obey E
  explicit FeatureStatistics(double threshold_px) : threshold_px_(threshold_px) {}

  void add(const RunMoment& moment);
  /// Ends the tracks that still live. Call once, before asking.
  void finish();

  [[nodiscard]] const std::vector<PairFeatures>& pairs() const { return pairs_; }
  /// How many tracks were seen in exactly that many images.
  [[nodiscard]] const std::map<std::size_t, std::size_t>& track_lengths() const { return lengths_; }
  /// Affine residuals of a region, row by row.
  [[nodiscard]] const std::vector<double>& residuals(int row, int column) const;
  /// Median of all regions' residuals; empty without any.
  [[nodiscard]] std::optional<double> median_residual() const;

 private:
  void follow(const TrackedPair& pair, PairFeatures& features);
  [[nodiscard]] std::vector<double> judge(const RunMoment& moment, const StepResult& step);

  double threshold_px_;
  std::vector<PairFeatures> pairs_;
  std::unordered_map<std::uint64_t, std::size_t> alive_;  ///< images so far
  std::map<std::size_t, std::size_t> lengths_;
  std::vector<std::vector<double>> residuals_{static_cast<std::size_t>(kColumns) * kRows};
};

/// Columns as in PairFeatures; empty where there is no residual.
[[nodiscard]] std::string format_pairs(const FeatureStatistics& statistics);
/// `images,tracks`.
[[nodiscard]] std::string format_track_lengths(const FeatureStatistics& statistics);
/// `row,column,count,median_affine_residual`.
[[nodiscard]] std::string format_regions(const FeatureStatistics& statistics);
/// A page of Markdown; its section "Time" depends on the clock.
[[nodiscard]] std::string format_summary(const FeatureStatistics& statistics,
                                         const std::string& extractor);

}  // namespace oneac::app
