#include "oneac/robust/graph_cut.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace oneac {
namespace {

constexpr int kMaxCells = 1000;  // per axis; four axes fit a 64-bit key

/// In halves, so that the extent of the largest doubles does not overflow.
struct Box {
  Eigen::Vector2d half_low;
  Eigen::Vector2d half_size;
};

Box box_of_first_view(AcSpan acs) {
  Eigen::Vector2d low = acs[0].x1;
  Eigen::Vector2d high = acs[0].x1;
  for (const AffineCorrespondence& ac : acs) {
    low = low.cwiseMin(ac.x1);
    high = high.cwiseMax(ac.x1);
  }
  return {0.5 * low, 0.5 * high - 0.5 * low};
}

std::uint64_t append_cell(std::uint64_t key, const Eigen::Vector2d& x, const Box& box, int cells) {
  for (int axis = 0; axis < 2; ++axis) {
    const double size = box.half_size(axis);
    const double share = size > 0.0 ? (0.5 * x(axis) - box.half_low(axis)) / size : 0.0;
    const double cell = std::clamp(share * cells, 0.0, static_cast<double>(cells - 1));
    key = key * static_cast<std::uint64_t>(cells) + static_cast<std::uint64_t>(cell);
  }
  return key;
}

}  // namespace

NeighbourPairs grid_neighbours(AcSpan acs, int cells) {
  if (cells < 1 || cells > kMaxCells) {
    throw std::invalid_argument("grid_neighbours: cells = " + std::to_string(cells) +
                                ", must be from 1 to " + std::to_string(kMaxCells));
  }
  NeighbourPairs pairs;
  if (acs.empty()) return pairs;
  const Box box = box_of_first_view(acs);
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
  order.reserve(acs.size());
  for (std::uint32_t i = 0; i < acs.size(); ++i) {
    order.emplace_back(append_cell(append_cell(0, acs[i].x1, box, cells), acs[i].x2, box, cells),
                       i);
  }
  std::sort(order.begin(), order.end());
  for (std::size_t a = 0; a < order.size(); ++a) {
    const std::size_t end = std::min(order.size(), a + 1 + kMaxNeighbours);
    for (std::size_t b = a + 1; b < end && order[b].first == order[a].first; ++b) {
      pairs.emplace_back(order[a].second, order[b].second);
    }
  }
  return pairs;
}

}  // namespace oneac
