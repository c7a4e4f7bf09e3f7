#include "flow_search.h"

#include "oneac/base/median.h"

#include <array>
#include <limits>
#include <utility>

namespace oneac::internal {
namespace {

// Levels at which a guess is tried: 3 px · 2^level is what its error may be.
constexpr std::size_t kForetold = 0;    // it goes on as a sample of the others does: 1 px
constexpr std::size_t kSteady = 1;      // the last motion goes on: 6 px
constexpr std::size_t kPredicted = 2;   // the last motion, the road, neighbours: 12 px
constexpr std::size_t kUnknown = 8;     // anything: the top of the pyramid
constexpr double kNeighbourhood = 150;  // [px] beyond it depths have nothing in common
// A neighbour's affine motion is extrapolated so far: beyond, it is hardly the same surface.
constexpr double kSameSurface = 30.0;  // [px]
// Of the old tracks every so many are found first and tell how the motion differs from the one
// expected; some sixty of them leave a third of a pixel.
constexpr std::size_t kSampleStep = 8;
constexpr double kPrecise = 0.5;  // [px] median error with which places are foretold

class TrackSearch {
 public:
  TrackSearch(const std::vector<KltTrack>& tracks, const FlowImages& images)
      : tracks_(tracks), seen_(tracks.size(), 0), motion_(images.motion), workers_(images.workers) {
    expect();
    flows_.reserve(workers_.count());
    while (flows_.size() < workers_.count()) {
      flows_.emplace_back(images.first, images.second, images.options);
    }
  }

  std::vector<std::optional<PatchMatch>> run() {
    Matches matches(tracks_.size());
    const auto old = which([&](std::size_t i) { return tracks_[i].age > 0; });
    std::vector<std::size_t> sample, others;
    for (std::size_t k = 0; k < old.size(); ++k) {
      (k % kSampleStep == 0 ? sample : others).push_back(old[k]);
    }
    const auto first_try = [this](std::size_t i) { return guesses(i); };
    find(sample, matches, first_try);
    correct(sample, matches);
    find(others, matches, first_try);
    remember(matches);
    find(which([&](std::size_t i) { return tracks_[i].age == 0; }), matches, first_try);
    return again(std::move(matches));
  }

  std::vector<std::optional<PatchMatch>> again(std::vector<std::optional<PatchMatch>> matches) {
    remember(matches);
    const auto lost =
        which([&](std::size_t i) { return !matches[i] && (seen_[i] == 0 || !is_precise_); });
    find(lost, matches, [this](std::size_t i) {
      std::vector<FlowGuess> second_try;
      add_neighbours(tracks_[i], second_try);
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
      matches[indices[k]] = flows_[worker].find(track.u, guesses(indices[k]), memory(track));
      seen_[indices[k]] = flows_[worker].has_seen() ? 1 : 0;
    });
  }

  /// Where each old track goes by itself.
  void expect() {
    expected_.resize(tracks_.size());
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      const KltTrack& track = tracks_[i];
      if (track.age == 0) continue;
      const auto place = motion_.goes_on(track.u - track.flow, track.u);
      expected_[i] = place.value_or(ExpectedPlace{track.u + track.flow, Eigen::Vector2d::Zero()});
    }
  }

  /// Learns from the sample how the motion differs from the one expected.
  void correct(const std::vector<std::size_t>& sample, const Matches& matches) {
    if (!motion_.is_known()) return;
    const PinholeCamera& camera = motion_.camera();
    const Eigen::Vector2d focal(camera.fx, camera.fy);
    std::vector<MissedPlace> places;
    for (const std::size_t i : sample) {
      if (!matches[i]) continue;
      places.push_back({camera.normalise(expected_[i].u), camera.normalise(matches[i]->warp.centre),
                        expected_[i].by_travel.cwiseQuotient(focal)});
    }
    const auto correction = correction_of(places);
    if (!correction) return;
    is_precise_ = correction->error * camera.focal_px() < kPrecise;
    for (ExpectedPlace& place : expected_) {
      const Eigen::Vector2d by_travel = place.by_travel.cwiseQuotient(focal);
      place.u += focal.cwiseProduct(correction->shift(camera.normalise(place.u), by_travel));
    }
    motion_ = motion_.corrected(*correction);
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

  [[nodiscard]] std::vector<FlowGuess> guesses(std::size_t index) const {
    return tracks_[index].age > 0 ? old_guesses(index) : fresh_guesses(tracks_[index]);
  }

  /// The place foretold; before anything is foretold the last motion, then the road.
  [[nodiscard]] std::vector<FlowGuess> old_guesses(std::size_t index) const {
    const KltTrack& track = tracks_[index];
    PatchWarp same;
    same.M = track.A;
    same.centre = is_precise_ ? expected_[index].u : track.u + track.flow;
    if (is_precise_) return {{same, kForetold, true}, {same, kSteady, true}};
    std::vector<FlowGuess> guesses = {{same, kSteady, true}, {same, kPredicted}};
    add_road(track, guesses);
    return guesses;
  }

  [[nodiscard]] std::vector<FlowGuess> fresh_guesses(const KltTrack& track) const {
    std::vector<FlowGuess> guesses;
    add_neighbours(track, guesses);
    add_road(track, guesses);
    PatchWarp still;
    still.centre = track.u;
    guesses.push_back({motion_.far_away(track.u).value_or(still), kUnknown});
    return guesses;
  }

  void add_road(const KltTrack& track, std::vector<FlowGuess>& guesses) const {
    const auto road = motion_.on_road(track.u);
    if (road) guesses.push_back({*road, kPredicted, is_precise_});
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
      guesses.push_back({warp, kPredicted, is_precise_});
    }
  }

  std::vector<PatchFlow> flows_;  ///< one per worker: it has patches to work on
  const std::vector<KltTrack>& tracks_;
  std::vector<ExpectedPlace> expected_;  ///< per track; of old ones
  std::vector<char> seen_;               ///< per track, whether its patch was seen, fit or not
  MotionPrediction motion_;
  bool is_precise_ = false;  ///< a sample was found within half a pixel of the places expected
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
