#include "log_pairs.h"

#include "oneac/features/ac_tracker.h"
#include "oneac/features/feature_options.h"
#include "oneac/geometry/levelling.h"
#include "oneac/rawlog/rawlog_source.h"
#include "oneac/robust/one_ac_consensus.h"

#include <utility>

namespace oneac {

std::vector<LogPair> pairs_of_log(const std::string& log, std::size_t every,
                                  const std::string& features) {
  SourceOptions source_options;
  source_options.log = log;
  source_options.every = every;
  RawlogSource source(source_options);
  FeatureOptions options;
  options.extractor = features;
  const auto tracker = make_tracker(options);
  std::vector<LogPair> pairs;
  CameraFrame before;
  MotionHint hint;
  while (const auto ticket = source.next()) {
    CameraFrame now = source.load(*ticket);
    hint.camera = now.camera;
    hint.R_level_cam = levelling_rotation(tilt_from_mounting(now.T_vehicle_cam.linear()));
    const bool first = before.camera.width == 0;
    const TrackedPair tracked = tracker->advance(tracker->prepare(now.image.view()), hint);
    if (!first) {
      LogPair pair{before.index, now.index, affine_parts(tracked), hint.R_level_cam,
                   now.camera.focal_px()};
      for (AffineCorrespondence& ac : pair.acs) ac = normalise(ac, before.camera, now.camera);
      const RobustResult seen = one_ac_consensus(pair.acs, pair.R_level_cam, pair.focal_px, {});
      if (seen.status != PoseStatus::kTooFew) hint.T_2_1 = seen.pose;
      pairs.push_back(std::move(pair));
    }
    before = std::move(now);
  }
  return pairs;
}

std::optional<RelativePose> true_motion(const LogPair& pair, const Trajectory& truth) {
  if (pair.index2 >= truth.poses.size()) return std::nullopt;
  const Eigen::Isometry3d T = truth.poses[pair.index2].inverse() * truth.poses[pair.index1];
  return RelativePose{T.linear(), T.translation()};
}

}  // namespace oneac
