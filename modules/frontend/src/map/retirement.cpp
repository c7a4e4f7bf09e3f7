#include "local_map.h"
#include "patch_geometry.h"

#include <algorithm>

namespace oneac {
namespace {

// [-] relative 1σ of the depth of a point that is worth keeping.
constexpr double kLocated = 0.1;

bool is_located(const Track& track) {
  const double rho = track.inverse_depth;
  return track.depth_information * rho * rho * kLocated * kLocated > 1.0;
}

}  // namespace

std::vector<MapPoint> LocalMap::retire_oldest() {
  std::vector<MapPoint> points;
  forget_sightings(window_.front().id, points);
  points.shrink_to_fit();  // they stay for the rest of the drive
  window_.pop_front();
  return points;
}

void LocalMap::forget_sightings(std::size_t id, std::vector<MapPoint>& points) {
  for (auto at = tracks_.begin(); at != tracks_.end();) {
    Track& track = at->second;
    const bool saw = !track.seen.empty() && track.seen.front().keyframe == id;
    if (!saw) {
      ++at;
      continue;
    }
    const bool leaves = track.seen.size() == (track.alive ? 1U : 2U);
    if (options_.keep_sightings && track.has_depth) keep_sightings(at->first, track, leaves);
    if (track.has_depth && leaves && is_located(track)) points.push_back(point_of(track));
    if (track.has_depth && !leaves && track.anchor == id) move_anchor(track);
    track.seen.erase(track.seen.begin());
    // What no pair of keyframes sees any more is settled; a living track may begin anew.
    if (track.seen.size() < 2) track.has_depth = track.has_depth && track.alive && !leaves;
    at = !track.alive && track.seen.size() < 2 ? tracks_.erase(at) : std::next(at);
  }
}

void LocalMap::keep_sightings(std::uint64_t id, const Track& track, bool leaves) {
  // A dead track leaves as a whole, with its last sighting in a keyframe that stays.
  const std::size_t count = leaves ? track.seen.size() : 1;
  for (std::size_t i = 0; i < count; ++i) {
    const Sighting& seen = track.seen[i];
    SettledSighting kept;
    kept.track = id;
    kept.keyframe = static_cast<std::uint32_t>(seen.keyframe);
    kept.point_sigma_px = static_cast<float>(seen.point_sigma * focal_px_);
    kept.affine_sigma = static_cast<float>(seen.affine_sigma);
    kept.u = (focal_px_ * seen.x).cast<float>();
    kept.shape = seen.shape.cast<float>();
    settled_.sightings.push_back(kept);
  }
  if (leaves && is_located(track)) settled_.of_points.push_back(id);
}

void LocalMap::move_anchor(Track& track) {
  const Sighting& from = track.seen[0];
  const Sighting& to = track.seen[1];
  const RelativePose T =
      keyframe(to.keyframe).T_cam_map * keyframe(from.keyframe).T_cam_map.inverse();
  const Eigen::Vector3d X = T * (track.ray.homogeneous() / track.inverse_depth);
  if (!(X.z() > 0.0)) {
    track.has_depth = false;
    return;
  }
  const Eigen::Vector3d m(track.gradient.x(), track.gradient.y(),
                          track.inverse_depth - track.gradient.dot(track.ray));
  track.anchor = to.keyframe;
  track.ray = X.head<2>() / X.z();
  track.inverse_depth = 1.0 / X.z();
  // The plane m·X = 1 of the old anchor is (R m)·X' = 1 + (R m)·t of the new one.
  const Eigen::Vector3d turned = T.R * m;
  const double offset = 1.0 + turned.dot(T.t);
  track.has_gradient = track.has_gradient && offset > 0.0;
  if (track.has_gradient) track.gradient = turned.head<2>() / offset;
}

MapPoint LocalMap::point_of(const Track& track) const {
  const RelativePose T_map_cam = keyframe(track.anchor).T_cam_map.inverse();
  MapPoint point;
  const double rho = track.inverse_depth;
  point.position = (T_map_cam * (track.ray.homogeneous() / rho)).cast<float>();
  point.grey = track.grey;
  point.views = static_cast<std::uint16_t>(track.seen.size());
  if (track.has_gradient) {
    // The plane n·X = d of the patch, turned towards the camera.
    const Eigen::Vector3d m(track.gradient.x(), track.gradient.y(),
                            rho - track.gradient.dot(track.ray));
    point.normal = -(T_map_cam.R * m.normalized()).cast<float>();
  }
  return point;
}

}  // namespace oneac
