#include "run_global.h"

#include "terminal/interrupt.h"
#include "terminal/progress_bar.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

namespace oneac::app {
namespace {

/// A track of a log; tracking that began anew makes another patch of it.
using TrackKey = std::tuple<std::size_t, std::size_t, std::uint64_t>;  // log, segment, track

/// Tracks of the drives, and where each is among the patches.
struct Tracks {
  DrivePatches drive;
  std::map<TrackKey, std::size_t> places;
};

/// A keyframe as its sightings name it, and where tracking began that it belongs to.
struct KeyframeName {
  std::size_t id, segment;
};

std::vector<KeyframeName> names_of(const KeyframeStore& keyframes) {
  std::vector<KeyframeName> names;
  for (std::size_t i = 0; i < keyframes.size(); ++i) {
    const Keyframe keyframe = keyframes[i];
    names.push_back({keyframe.id, keyframe.segment});
  }
  return names;
}

/// Place of a keyframe in its record. @pre it has settled
std::size_t place_of(std::uint32_t id, const std::vector<KeyframeName>& keyframes) {
  const auto at =
      std::lower_bound(keyframes.begin(), keyframes.end(), id,
                       [](const KeyframeName& k, std::uint32_t other) { return k.id < other; });
  return static_cast<std::size_t>(at - keyframes.begin());
}

/// In lengths of the focal length at the end of the drive, which is the loops' camera.
PatchSighting to_patch_sighting(const SettledSighting& seen, double focal_px, double noise_px) {
  PatchSighting out;
  const auto focal = static_cast<float>(focal_px);
  const bool known = seen.point_sigma_px > 0.0F;
  out.point_sigma = (known ? seen.point_sigma_px : static_cast<float>(noise_px)) / focal;
  out.affine_sigma = seen.affine_sigma;
  out.x = seen.u / focal;
  out.A = seen.shape;
  return out;
}

void add_tracks(const DriveRecord& record, std::size_t log, std::size_t first_keyframe,
                double noise_px, Tracks& tracks) {
  auto& patches = tracks.drive.patches;
  const std::vector<KeyframeName> keyframes = names_of(record.keyframes);
  for (const SettledSighting& settled : record.tracks.sightings) {
    const std::size_t place = place_of(settled.keyframe, keyframes);
    if (place == keyframes.size()) continue;
    const TrackKey key{log, keyframes[place].segment, settled.track};
    const auto [at, fresh] = tracks.places.try_emplace(key, patches.size());
    if (fresh) patches.emplace_back();
    PatchSighting seen = to_patch_sighting(settled, tracks.drive.focal_px, noise_px);
    seen.keyframe = static_cast<std::uint32_t>(first_keyframe + place);
    patches[at->second].push_back(seen);
  }
}

/// Affinities from where a track began to from where it was first seen.
void begin_at_first_sighting(SharedPatch& patch) {
  const Eigen::Matrix2f from_first = patch.front().A.inverse();
  for (PatchSighting& seen : patch) seen.A *= from_first;
}

Tracks tracks_of(const std::vector<RecordedDrive>& drives, double focal_px) {
  Tracks tracks;
  tracks.drive.focal_px = focal_px;
  std::size_t begin = 0;
  for (std::size_t log = 0; log < drives.size(); ++log) {
    const double noise_px = drives[log].options->front_end.window.refine.point_noise_px;
    add_tracks(*drives[log].record, log, begin, noise_px, tracks);
    begin += drives[log].record->keyframes.size();
  }
  for (SharedPatch& patch : tracks.drive.patches) begin_at_first_sighting(patch);
  return tracks;
}

/// Of a log's map points, in their order, where they are now.
std::vector<std::optional<Eigen::Vector3d>> points_of(const DriveRecord& record, std::size_t log,
                                                      const Tracks& tracks,
                                                      const GlobalAdjustment& adjusted) {
  std::vector<std::optional<Eigen::Vector3d>> points;
  for (std::size_t k = 0; k < record.keyframes.size(); ++k) {
    const Keyframe keyframe = record.keyframes[k];
    const std::size_t count = record.keyframes.points(k).size();
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t at = points.size();
      points.emplace_back();
      if (at >= record.tracks.of_points.size()) continue;
      const auto found = tracks.places.find({log, keyframe.segment, record.tracks.of_points[at]});
      if (found != tracks.places.end()) points.back() = adjusted.points[found->second];
    }
  }
  return points;
}

}  // namespace

void adjust_closed_drives(const std::vector<RecordedDrive>& drives, ClosedDrives& closed) {
  if (!closed.searched) {
    closed.global.emplace().reason = "the search for loops was not finished";
    return;
  }
  const RunOptions& options = *drives.front().options;
  const Tracks tracks =
      tracks_of(drives, camera_of_loops(*drives.front().record, options).focal_px());
  ProgressBar progress(options.run.progress && !options.run.quiet, "adjustments");
  std::size_t asked = 0;
  const auto stop = [&] {
    progress.update(++asked);
    return interrupted();
  };
  const GlobalAdjustment adjusted =
      adjust_globally(closed.keyframes, closed.graph, tracks.drive, options.global_ba, stop);
  closed.global = adjusted.report;
  if (!adjusted.report.adjusted) return;
  closed.T_of_graph = std::exchange(closed.graph.T_first_cam, adjusted.T_first_cam);
  for (std::size_t log = 0; log < drives.size(); ++log) {
    closed.points.push_back(points_of(*drives[log].record, log, tracks, adjusted));
  }
}

}  // namespace oneac::app
