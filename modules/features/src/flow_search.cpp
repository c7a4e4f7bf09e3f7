#include "flow_search.h"

#include <array>
#include <limits>

namespace oneac::internal {
namespace {

// Levels at which a guess is tried: 3 px · 2^level is what its error may be.
constexpr std::size_t kPredicted = 2;   // the last motion, the road, neighbours: 12 px
constexpr std::size_t kUnknown = 8;     // anything: the top of the pyramid
constexpr double kNeighbourhood = 150;  // [px] beyond it depths have nothing in common
// A neighbour's affine motion is extrapolated so far: beyond, it is hardly the same surface.
constexpr double kSameSurface = 30.0;  // [px]

class TrackSearch {
 public:
  TrackSearch(const std::vector<KltTrack>& tracks, const ImagePyramid& first,
              const ImagePyramid& second, const MotionPrediction& motion, const KltOptions& options)
      : tracks_(tracks), motion_(motion), flow_(first, second, options), matches_(tracks.size()) {}

  std::vector<std::optional<PatchMatch>> run() {
    std::vector<std::size_t> lost;
    for (const bool fresh : {false, true}) {
      for (std::size_t i = 0; i < tracks_.size(); ++i) {
        if ((tracks_[i].age == 0) != fresh) continue;
        matches_[i] = flow_.find(tracks_[i].u, guesses(tracks_[i]), memory(tracks_[i]));
        if (!matches_[i]) lost.push_back(i);
      }
      found_ = matches_;  // neighbours of what follows: never of a result of the same round
    }
    for (const std::size_t i : lost) {
      std::vector<FlowGuess> second_try;
      add_neighbours(tracks_[i], second_try);
      if (second_try.empty()) continue;
      matches_[i] = flow_.find(tracks_[i].u, second_try, memory(tracks_[i]));
    }
    return std::move(matches_);
  }

 private:
  static PatchMemory memory(const KltTrack& track) {
    return {track.reference_is_here ? track.reference.get() : nullptr, track.window};
  }

  [[nodiscard]] std::vector<FlowGuess> guesses(const KltTrack& track) const {
    std::vector<FlowGuess> guesses;
    if (track.age > 0) {
      PatchWarp same;
      same.M = track.A;
      same.centre = track.u + track.flow;
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
      if (!found_[i]) continue;
      const double d = (tracks_[i].u - track.u).squaredNorm();
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
      const PatchWarp& theirs = found_[nearest[k]]->warp;
      const Eigen::Vector2d offset = track.u - tracks_[nearest[k]].u;
      PatchWarp warp;
      warp.M = theirs.M;
      warp.centre = theirs.centre + (offset.norm() < kSameSurface ? theirs.M * offset : offset);
      guesses.push_back({warp, kPredicted});
    }
  }

  const std::vector<KltTrack>& tracks_;
  const MotionPrediction& motion_;
  PatchFlow flow_;
  std::vector<std::optional<PatchMatch>> matches_, found_;
};

}  // namespace

std::vector<std::optional<PatchMatch>> search_tracks(const std::vector<KltTrack>& tracks,
                                                     const ImagePyramid& first,
                                                     const ImagePyramid& second,
                                                     const MotionPrediction& motion,
                                                     const KltOptions& options) {
  return TrackSearch(tracks, first, second, motion, options).run();
}

}  // namespace oneac::internal
