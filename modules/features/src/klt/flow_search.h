#pragma once

#include "klt_track.h"
#include "motion_prediction.h"
#include "patch/patch_flow.h"

#include "oneac/base/workers.h"

#include <optional>
#include <vector>

namespace oneac::internal {

/// Two images with what tells where to look, and who looks.
struct FlowImages {
  const ImagePyramid& first;
  const ImagePyramid& second;
  const MotionPrediction& motion;
  const KltOptions& options;
  Workers& workers;
};

/// Finds all tracks of the first image in the second: a sample of the old tracks first, from their
/// last motion; it corrects the motion expected, which foretells the other old ones; then fresh
/// ones, from their neighbours' motion and from the hint; then once more what was not seen, from
/// the neighbours found meanwhile. One match per track, in their order.
[[nodiscard]] std::vector<std::optional<PatchMatch>> search_tracks(
    const std::vector<KltTrack>& tracks, const FlowImages& images);
/// Once more the tracks that have no match yet, from the motion of the nearest that have one.
void search_lost_tracks(const std::vector<KltTrack>& tracks, const FlowImages& images,
                        std::vector<std::optional<PatchMatch>>& matches);

/// Median way of the tracks that were found [px]; 0 where none was.
[[nodiscard]] double median_flow(const std::vector<KltTrack>& tracks,
                                 const std::vector<std::optional<PatchMatch>>& matches);

}  // namespace oneac::internal
