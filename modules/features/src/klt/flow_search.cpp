#include "flow_search.h"

#include "oneac/base/median.h"

#include <array>
#include <limits>
#include <utility>

namespace oneac::internal {
namespace {

// Levels at which a guess is tried: 3 px · 2^level is what its error may be.
constexpr std::size_t kSteady = 1;      // the last motion goes on: 6 px
constexpr std::size_t kPredicted = 2;   // the last motion, the road, neighbours: 12 px
constexpr std::size_t kUnknown = 8;     // anything: the top of the pyramid
constexpr double kNeighbourhood = 150;  // [px] beyond it depths have nothing in common
// A neighbour's affine motion is extrapolated so far: beyond, it is hardly the same surface.
constexpr double kSameSurface = 30.0;  // [px]

class TrackSearch {
 public:
  TrackSearch(const std::vector<KltTrack>& tracks, const FlowImages& images)
      : tracks_(tracks), motion_(images.motion), workers_(images.workers) {
    flows_.reserve(workers_.count());
    while (flows_.size() < workers_.count()) {
      flows_.emplace_back(images.first, images.second, images.options);
    }
  }

  std::vector<std::optional<PatchMatch>> run() {
    Matches matches(tracks_.size());
    for (const bool fresh : {false, true}) {
      const auto now = which([&](std::size_t i) { return (tracks_[i].age == 0) == fresh; });
      find(now, matches, [this](const KltTrack& track) { return guesses(track); });
      remember(matches);
    }
    return again(std::move(matches));
  }

  std::vector<std::optional<PatchMatch>> again(std::vector<std::optional<PatchMatch>> matches) {
    remember(matches);
    const auto lost = which([&](std::size_t i) { return !matches[i].has_value(); });
    find(lost, matches, [this](const KltTrack& track) {
      std::vector<FlowGuess> second_try;
      add_neighbours(track, second_try);
      return second_try;
    });
    return matches;
  }

 private:
  struct Neighbour {
    Eigen::Vector2d u1;
    PatchWarp warp;
  };

  using Matches = std::vector<std::optional<PatchMatch>>;

  template <class Condition>
  [[nodiscard]] std::vector<std::size_t> which(const Condition& condition) const {
    std::vector<std::size_t> indices;
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      if (condition(i)) indices.push_back(i);
    }
    return indices;
  }

  /// Each from its guesses and from neighbours of earlier rounds, so that any order will do.
  template <class Guesses>
  void find(const std::vector<std::size_t>& indices, Matches& matches, const Guesses& guesses) {
    workers_.share(indices.size(), [&](std::size_t k, std::size_t worker) {
      const KltTrack& track = tracks_[indices[k]];
      matches[indices[k]] = flows_[worker].find(track.u, guesses(track), memory(track));
    });
  }

  void remember(const Matches& matches) {
    found_.clear();
    for (std::size_t i = 0; i < matches.size(); ++i) {
      if (matches[i]) found_.push_back({tracks_[i].u, matches[i]->warp});
    }
  }

  static PatchMemory memory(const KltTrack& track) {
    return {track.reference_is_here ? track.reference.get() : nullptr, track.window, track.age > 0};
  }

  [[nodiscard]] std::vector<FlowGuess> guesses(const KltTrack& track) const {
    std::vector<FlowGuess> guesses;
    if (track.age > 0) {
      PatchWarp same;
      same.M = track.A;
      same.centre = track.u + track.flow;
      guesses.push_back({same, kSteady});
      guesses.push_back({same, kPredicted});
    } else {
      add_neighbours(track, guesses);
    }
    if (const auto road = motion_.on_road(track.u)) guesses.push_back({*road, kPredicted});
    if (track.age > 0) return guesses;
    PatchWarp still;
    still.centre = track.u;
    guesses.push_back({motion_.far_away(track.u).value_or(still), kUnknown});
    return guesses;
  }

  /// The motion of the two nearest tracks found.
  void add_neighbours(const KltTrack& track, std::vector<FlowGuess>& guesses) const {
    std::array<std::size_t, 2> nearest{};
    std::array<double, 2> distance{};
    distance.fill(kNeighbourhood * kNeighbourhood);
    std::size_t count = 0;
    for (std::size_t i = 0; i < found_.size(); ++i) {
      const double d = (found_[i].u1 - track.u).squaredNorm();
      if (d >= distance[1]) continue;
      const std::size_t slot = d < distance[0] ? 0 : 1;
      if (slot == 0) {
        nearest[1] = nearest[0];
        distance[1] = distance[0];
      }
      nearest[slot] = i;
      distance[slot] = d;
      count = std::min<std::size_t>(count + 1, 2);
    }
    for (std::size_t k = 0; k < count; ++k) {
      const PatchWarp& theirs = found_[nearest[k]].warp;
      const Eigen::Vector2d offset = track.u - found_[nearest[k]].u1;
      PatchWarp warp;
      warp.M = theirs.M;
      warp.centre = theirs.centre + (offset.norm() < kSameSurface ? theirs.M * offset : offset);
      guesses.push_back({warp, kPredicted});
    }
  }

  std::vector<PatchFlow> flows_;  ///< one per worker: it has patches to work on
  const std::vector<KltTrack>& tracks_;
  const MotionPrediction& motion_;
  Workers& workers_;
  std::vector<Neighbour> found_;
};

}  // namespace

std::vector<std::optional<PatchMatch>> search_tracks(const std::vector<KltTrack>& tracks,
                                                     const FlowImages& images) {
  return TrackSearch(tracks, images).run();
}

void search_lost_tracks(const std::vector<KltTrack>& tracks, const FlowImages& images,
                        std::vector<std::optional<PatchMatch>>& matches) {
  matches = TrackSearch(tracks, images).again(std::move(matches));
}

double median_flow(const std::vector<KltTrack>& tracks,
                   const std::vector<std::optional<PatchMatch>>& matches) {
  std::vector<double> flows;
  for (std::size_t i = 0; i < tracks.size(); ++i)
    if (matches[i]) flows.push_back((matches[i]->warp.centre - tracks[i].u).norm());
  if (flows.empty()) return 0.0;
  return upper_median(std::move(flows));
}

}  // namespace oneac::internal
