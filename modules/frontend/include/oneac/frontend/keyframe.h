#pragma once

#include "oneac/geometry/relative_pose.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace oneac {

/// A landmark of the map, as it was when its last keyframe settled. Single precision, since a long
/// drive has millions: a millimetre at ten kilometres from the start.
struct MapPoint {
  Eigen::Vector3f position = Eigen::Vector3f::Zero();  ///< in the first camera's frame
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();    ///< unit, towards the camera; zero: unknown
  std::uint8_t grey = 0;                               ///< of the image where it was first seen
  std::uint16_t views = 0;                             ///< keyframes that saw it
};

/// A keyframe that will not move any more, with its constraint to the one before.
struct Keyframe {
  std::size_t id = 0;       ///< counts keyframes from 0
  std::size_t frame = 0;    ///< counts processed frames from 0
  std::size_t index = 0;    ///< image of the camera in the log
  double time_s = 0.0;      ///< [s]
  std::size_t segment = 0;  ///< raised when tracking had to start anew
  Eigen::Isometry3d T_first_cam = Eigen::Isometry3d::Identity();
  bool metric = false;  ///< lengths are metres
  /// Information of the pose of this keyframe relative to the one before, T_before_this, as g2o
  /// wants it: translation first, then rotation, of a change on the right (in this camera's frame).
  /// Zero for the first.
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
  std::vector<MapPoint> points;  ///< landmarks whose last sight this keyframe was anchored to
};

/// A track where the newest keyframe sees it.
struct KeyframeSighting {
  std::uint64_t track = 0;                      ///< the same in every keyframe
  Eigen::Vector2d x = Eigen::Vector2d::Zero();  ///< normalised by the camera in use [-]
};

/// A track where a keyframe saw it, as it was when that settled. Single precision: a drive has
/// hundreds a keyframe.
struct SettledSighting {
  std::uint64_t track = 0;      ///< the same in every keyframe
  std::uint32_t keyframe = 0;   ///< Keyframe::id
  float point_sigma_px = 0.0F;  ///< 1σ of a coordinate; 0 where unknown
  float affine_sigma = 0.0F;    ///< 1σ of an entry of `shape` [-]; 0 where unknown
  /// [px] of the focal length in use then, from the principal point.
  Eigen::Vector2f u = Eigen::Vector2f::Zero();
  Eigen::Matrix2f shape = Eigen::Matrix2f::Identity();  ///< ∂u/∂(u where the track began)
};

/// Tracks of a drive that have left its map.
struct SettledTracks {
  std::vector<SettledSighting> sightings;  ///< of landmarks; those of a track in order
  std::vector<std::uint64_t> of_points;    ///< track of every MapPoint, in the order of settling
};

/// The newest keyframe as it is before others adjust it: what a calibration needs of it.
struct NewestKeyframe {
  RelativePose T_cam_map;                   ///< lengths of the map
  std::vector<KeyframeSighting> sightings;  ///< in the order of their tracks
};

/// Final pose of a frame.
struct SettledFrame {
  std::size_t frame = 0;  ///< counts processed frames from 0
  Eigen::Isometry3d T_first_cam = Eigen::Isometry3d::Identity();
};

/// What became final.
struct Settled {
  std::vector<SettledFrame> frames;
  std::vector<Keyframe> keyframes;
};

}  // namespace oneac
