#include "repeated_view.h"

#include "two_view.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace oneac {
namespace {

constexpr double kRests = 3.0;       // [σ] up to which a point rests
constexpr double kLeastSigma = 0.1;  // [px] of blocks that compression leaves in place
constexpr double kMoves = 3.0;       // times as far goes what moves
constexpr std::size_t kLeast = 20;   // points to tell it by
// [-] of them that rest: in a repeat all do but those that noise has led astray. So many of the
// quarter that went farthest, too, which are the near ones.
constexpr double kNearlyAll = 0.8;
constexpr std::size_t kFarthest = 4;
// [-] of a picture that was taken for standing as a whole, by a sample three quarters of which
// rest: so many have to have moved that most of these are among them.
constexpr double kMost = 0.6;
constexpr double kMemory = 1.0;  // [s]

struct Look {
  double before_px = 0.0;
  bool rests = false;
};

double share_at_rest(const std::vector<Look>& looks, std::size_t count) {
  const auto end = looks.begin() + static_cast<std::ptrdiff_t>(count);
  const auto rest = std::count_if(looks.begin(), end, [](const Look& look) { return look.rests; });
  return static_cast<double>(rest) / static_cast<double>(count);
}

bool all_rest(std::vector<Look> looks) {
  if (looks.size() < kLeast) return false;
  const std::size_t farthest = looks.size() / kFarthest;
  std::nth_element(looks.begin(), looks.begin() + static_cast<std::ptrdiff_t>(farthest),
                   looks.end(),
                   [](const Look& a, const Look& b) { return a.before_px > b.before_px; });
  return share_at_rest(looks, looks.size()) >= kNearlyAll &&
         share_at_rest(looks, farthest) >= kNearlyAll;
}

}  // namespace

bool RepeatedView::repeats(const TrackedPair& pair, double focal_px, double begin_s, double end_s) {
  if (begin_s - time_s_ > kMemory) before_.clear();
  std::size_t known = 0;
  std::vector<Look> looks;  // at what moved
  std::unordered_map<std::uint64_t, Travel> now;
  now.reserve(pair.size());
  for (const Correspondence& ac : pair.correspondences) {
    const double rest_px = kRests * std::max(focal_px * point_sigma(ac, focal_px), kLeastSigma);
    const double px = focal_px * (ac.x2 - ac.moved - ac.x1).norm();
    now[ac.track] = {px, px > kMoves * rest_px};
    const auto before = before_.find(ac.track);
    if (before == before_.end()) continue;
    ++known;
    if (before->second.moves) looks.push_back({before->second.px, px <= rest_px});
  }
  const bool told =
      !pair.standing || static_cast<double>(looks.size()) >= kMost * static_cast<double>(known);
  if (told && all_rest(std::move(looks))) return true;
  before_ = std::move(now);
  time_s_ = end_s;
  return false;
}

}  // namespace oneac
