#include "oneac/features/descriptor_matching.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

namespace oneac {
namespace {

using Descriptors = AffineFeatures::Descriptors;

constexpr Eigen::Index kBlock =
    256;  // rows per product: similarities stay in the second-level cache

/// The two best candidates of one feature by cosine similarity.
struct Best {
  int index = -1;
  float first = -2.0F;
  float second = -2.0F;

  void offer(int candidate, float similarity) {
    if (similarity > first) {
      second = first;
      first = similarity;
      index = candidate;
    } else if (similarity > second) {
      second = similarity;
    }
  }
};

struct BothWays {
  std::vector<Best> forward;
  std::vector<Best> backward;
};

/// Best partners in both directions from one pass over all products, block by block.
BothWays best_partners(const Descriptors& a, const Descriptors& b) {
  BothWays best{std::vector<Best>(static_cast<std::size_t>(a.rows())),
                std::vector<Best>(static_cast<std::size_t>(b.rows()))};
  Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> similarity;
  for (Eigen::Index start = 0; start < a.rows(); start += kBlock) {
    const Eigen::Index rows = std::min(kBlock, a.rows() - start);
    similarity.noalias() = a.middleRows(start, rows) * b.transpose();
    for (Eigen::Index i = 0; i < rows; ++i) {
      Best& forward = best.forward[static_cast<std::size_t>(start + i)];
      for (Eigen::Index j = 0; j < b.rows(); ++j) {
        const float s = similarity(i, j);
        forward.offer(static_cast<int>(j), s);
        best.backward[static_cast<std::size_t>(j)].offer(static_cast<int>(start + i), s);
      }
    }
  }
  return best;
}

/// Squared distance of unit vectors from their cosine.
double squared_distance(float cosine) {
  return std::max(0.0, 2.0 - 2.0 * static_cast<double>(cosine));
}

bool passes_ratio(const Best& best, double ratio) {
  return squared_distance(best.first) < ratio * ratio * squared_distance(best.second);
}

bool passes_gates(const AffineCorrespondence& ac, const MatchOptions& options) {
  const double det = ac.A.determinant();
  if (!(det > 0.0)) return false;
  const double scale = std::sqrt(det);
  return scale <= options.max_scale && scale >= 1.0 / options.max_scale &&
         (ac.x2 - ac.x1).norm() <= options.max_shift_px;
}

struct Match {
  AffineCorrespondence ac;
  float similarity;
};

/// Keeps the most similar of matches whose point falls into the same pixel, for `point` of view 1
/// or 2.
template <class Point>
std::vector<Match> unique_by(std::vector<Match> matches, Point&& point) {
  std::map<std::pair<long, long>, std::size_t> best_at;
  std::vector<bool> keep(matches.size(), false);
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const Eigen::Vector2d& u = point(matches[i].ac);
    const auto [slot, fresh] = best_at.try_emplace({std::lround(u.x()), std::lround(u.y())}, i);
    if (fresh) {
      keep[i] = true;
    } else if (matches[i].similarity > matches[slot->second].similarity) {
      keep[slot->second] = false;
      keep[i] = true;
      slot->second = i;
    }
  }
  std::vector<Match> kept;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (keep[i]) kept.push_back(matches[i]);
  }
  return kept;
}

}  // namespace

std::vector<AffineCorrespondence> match_features(const AffineFeatures& first,
                                                 const AffineFeatures& second,
                                                 const MatchOptions& options) {
  if (first.frames.empty() || second.frames.empty()) return {};
  const BothWays best = best_partners(first.descriptors, second.descriptors);
  std::vector<Match> matches;
  for (std::size_t i = 0; i < best.forward.size(); ++i) {
    const Best& forward = best.forward[i];
    const auto partner = static_cast<std::size_t>(forward.index);
    if (options.mutual && best.backward[partner].index != static_cast<int>(i)) continue;
    if (!passes_ratio(forward, options.snn_ratio)) continue;
    const AffineFrame& from = first.frames[i];
    const AffineFrame& to = second.frames[partner];
    const AffineCorrespondence ac{from.centre, to.centre, to.shape * from.shape.inverse()};
    if (ac.is_finite() && passes_gates(ac, options)) matches.push_back({ac, forward.first});
  }
  matches = unique_by(
      std::move(matches), [](const auto& ac) -> const auto& { return ac.x1; });
  matches = unique_by(
      std::move(matches), [](const auto& ac) -> const auto& { return ac.x2; });
  std::vector<AffineCorrespondence> acs;
  acs.reserve(matches.size());
  for (const Match& match : matches) acs.push_back(match.ac);
  return acs;
}

}  // namespace oneac
