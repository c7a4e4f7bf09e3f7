#pragma once

#include "oneac/comparison/pair_record.h"
#include "oneac/comparison/settings.h"
#include "oneac/report/overlay.h"

#include <cstddef>
#include <string>
#include <vector>

namespace oneac {

/// A pair of the report with its picture.
struct PairOverlay {
  std::size_t pair = 0;    ///< index into ComparisonData::pairs
  std::size_t method = 0;  ///< whose inliers are drawn
  Overlay picture;
};

/// The pairs where a method did worst: the largest rotation or direction error in units of what
/// counts as failure; without a reference, the smallest share of inliers.
[[nodiscard]] std::vector<std::size_t> worst_pairs(const ComparisonData& data, std::size_t method,
                                                   std::size_t count);

/// The method whose worst pairs are shown: "1ac_pooled" when it takes part, else the first.
[[nodiscard]] std::size_t shown_method(const ComparisonData& data);

/// The correspondences of the worst pairs over the second image, inliers and outliers apart.
/// The pairs are extracted and estimated once more. Logs that are not there give nothing.
[[nodiscard]] std::vector<PairOverlay> draw_worst_pairs(const ComparisonData& data,
                                                        const CompareSettings& settings,
                                                        std::size_t count);

}  // namespace oneac
