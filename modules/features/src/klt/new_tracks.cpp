// Where a KltTracker starts tracks.

#include "klt_tracker.h"

#include <algorithm>
#include <utility>

namespace oneac::internal {
namespace {

constexpr int kRounds = 4;  // corners per cell before the search for corners ends

}  // namespace

void KltTracker::start_tracks(const KltFrame& now, const std::vector<Corner>& corners) {
  std::vector<std::unique_ptr<AnchoredPatch>> patches(corners.size());
  workers_->share(corners.size(), [&](std::size_t i, std::size_t) {
    auto patch = std::make_unique<AnchoredPatch>();
    const std::size_t window = window_for_corner(corners[i].score);
    if (anchor_adapted(now.pyramid, corners[i].u, *patch, window)) patches[i] = std::move(patch);
  });
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (!patches[i]) continue;
    KltTrack track;
    track.id = next_id_++;
    track.u = corners[i].u;
    track.reference = std::move(patches[i]);
    track.reference_is_here = true;
    tracks_.push_back(std::move(track));
  }
}

std::vector<Corner> KltTracker::offers(const KltFrame& now, const Occupancy& taken,
                                       int round) const {
  std::vector<Corner> offers;
  for (std::size_t cell = 0; cell < taken.in_cell.size(); ++cell) {
    if (taken.in_cell[cell] >= round || static_points_.is_blocked(cell)) continue;
    for (const Corner& corner : now.corners.cells[cell]) {
      const bool is_free = taken.points.is_free(corner.u, options_.klt.min_distance_px);
      if (!is_free || !car_mask_.usable(corner.u)) continue;
      offers.push_back(corner);
      break;
    }
  }
  std::stable_sort(offers.begin(), offers.end(),
                   [](const Corner& a, const Corner& b) { return a.score > b.score; });
  return offers;
}

void KltTracker::replenish(const KltFrame& now) {
  const auto limit = static_cast<std::size_t>(options_.klt.max_tracks);
  const double distance = options_.klt.min_distance_px;
  Occupancy taken{{now.pyramid.width(), now.pyramid.height(), distance},
                  std::vector<int>(now.corners.cells.size(), 0)};
  const auto take_place = [&](const Eigen::Vector2d& u) {
    taken.points.add(u);
    ++taken.in_cell[cell_of(now, u)];
  };
  for (const KltTrack& track : tracks_) take_place(track.u);
  for (int round = 1; round <= kRounds && tracks_.size() < limit; ++round) {
    const std::vector<Corner> offered = offers(now, taken, round);
    for (auto offer = offered.begin(); offer != offered.end() && tracks_.size() < limit;) {
      std::vector<Corner> starting;  // as many as there is room for, should each be followed
      for (; offer != offered.end() && tracks_.size() + starting.size() < limit; ++offer) {
        if (!taken.points.is_free(offer->u, distance)) continue;
        take_place(offer->u);
        starting.push_back(*offer);
      }
      start_tracks(now, starting);
    }
  }
}

}  // namespace oneac::internal
