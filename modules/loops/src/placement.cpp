#include "placement.h"

#include "chain.h"

#include <map>
#include <optional>
#include <utility>

namespace oneac::internal {
namespace {

/// Two parts that lie in one frame.
struct Tie {
  std::size_t a = 0, b = 0;                                 ///< a < b
  std::size_t strength = 0;                                 ///< loops; 0: the odometry's guess
  Eigen::Isometry3d T_a_b = Eigen::Isometry3d::Identity();  ///< frame of b's odometry in a's
};

/// Of parts whose loops all say the same: as the one in the middle says.
void add_loop_ties(const std::vector<LoopKeyframe>& keyframes,
                   const std::vector<LoopConstraint>& loops, const Chain& chain,
                   std::vector<Tie>& ties) {
  std::map<std::pair<std::size_t, std::size_t>, std::vector<const LoopConstraint*>> pairs;
  for (const LoopConstraint& loop : loops) {
    if (chain.known(loop.first, loop.second)) continue;
    pairs[{chain.part(loop.first), chain.part(loop.second)}].push_back(&loop);
  }
  for (const auto& [parts, all] : pairs) {
    const LoopConstraint& middle = *all[all.size() / 2];
    const Eigen::Isometry3d T = keyframes[middle.first].T_first_cam * of_loop(middle).T *
                                keyframes[middle.second].T_first_cam.inverse();
    ties.push_back({parts.first, parts.second, all.size(), T});
  }
}

/// Of parts that follow each other in one log.
void add_odometry_ties(const std::vector<LoopKeyframe>& keyframes, const Chain& chain,
                       std::vector<Tie>& ties) {
  for (std::size_t i = 1; i < keyframes.size(); ++i) {
    if (chain.known(i - 1, i) || keyframes[i - 1].log != keyframes[i].log) continue;
    ties.push_back({chain.part(i - 1), chain.part(i), 0, Eigen::Isometry3d::Identity()});
  }
}

/// Parts as they are put into frames, one after the other.
class Frames {
 public:
  explicit Frames(std::size_t parts) : placed_(parts), root_(parts, 0) {}

  void begin_at(std::size_t part) {
    placed_[part] = Eigen::Isometry3d::Identity();
    root_[part] = part;
  }

  /// The strongest tie that leads on from what has a place, and along it. @return whether any does
  bool go_on(const std::vector<Tie>& ties) {
    const Tie* best = nullptr;
    for (const Tie& tie : ties) {
      if (placed_[tie.a].has_value() == placed_[tie.b].has_value()) continue;
      if (best == nullptr || tie.strength > best->strength) best = &tie;
    }
    if (best == nullptr) return false;
    const bool ahead = placed_[best->a].has_value();
    const std::size_t from = ahead ? best->a : best->b, to = ahead ? best->b : best->a;
    placed_[to] = *placed_[from] * (ahead ? best->T_a_b : best->T_a_b.inverse());
    root_[to] = root_[from];
    return true;
  }

  [[nodiscard]] bool has(std::size_t part) const { return placed_[part].has_value(); }
  [[nodiscard]] const Eigen::Isometry3d& of(std::size_t part) const { return *placed_[part]; }
  [[nodiscard]] std::size_t root(std::size_t part) const { return root_[part]; }

 private:
  std::vector<std::optional<Eigen::Isometry3d>> placed_;
  std::vector<std::size_t> root_;
};

}  // namespace

Placement place_parts(const std::vector<LoopKeyframe>& keyframes,
                      const std::vector<LoopConstraint>& loops) {
  Placement placement;
  if (keyframes.empty()) return placement;
  Chain chain;
  for (const LoopKeyframe& keyframe : keyframes) chain.add(keyframe);
  std::vector<Tie> ties;
  add_loop_ties(keyframes, loops, chain, ties);
  add_odometry_ties(keyframes, chain, ties);
  const std::size_t parts = chain.part(keyframes.size() - 1) + 1;
  Frames frames(parts);
  for (std::size_t part = 0; part < parts; ++part) {
    if (frames.has(part)) continue;
    frames.begin_at(part);
    while (frames.go_on(ties)) continue;
  }
  std::vector<std::optional<std::size_t>> first_of(parts);
  for (std::size_t i = 0; i < keyframes.size(); ++i) {
    const std::size_t part = chain.part(i);
    auto& first = first_of[frames.root(part)];
    if (!first) first = i;
    placement.T_group_cam.push_back(frames.of(part) * keyframes[i].T_first_cam);
    placement.group.push_back(*first);
  }
  return placement;
}

}  // namespace oneac::internal
