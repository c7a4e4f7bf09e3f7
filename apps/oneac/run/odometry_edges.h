#pragma once

#include "drive_record.h"

#include "oneac/evaluation/trajectory_io.h"
#include "oneac/frontend/keyframe.h"
#include "oneac/frontend/loop_keyframes.h"

#include <cstddef>
#include <ostream>
#include <vector>

namespace oneac::app {

/// The steps of a drive by their frame. @pre the record outlives what is returned
[[nodiscard]] StepTo steps_of(const DriveRecord& record);

/// The keyframes without points, each edge as uncertain as its steps are together. The window's own
/// information is that of a keyframe whose landmarks are known: it adds up to a fraction of the
/// drift, and would have a back-end refuse true loops.
[[nodiscard]] std::vector<Keyframe> keyframes_by_steps(const DriveRecord& record);
/// One of them.
[[nodiscard]] Keyframe keyframe_by_steps(const DriveRecord& record, std::size_t i);

/// A keyframes.tum of a KeyframeStore or of a vector of keyframes.
template <class Keyframes>
void write_keyframes(const Keyframes& keyframes, std::ostream& out) {
  for (std::size_t i = 0; i < keyframes.size(); ++i) {
    const auto& keyframe = keyframes[i];
    // A map that begins anew begins at the last frame, which may have closed the map before.
    const bool again = i + 1 < keyframes.size() && keyframes[i + 1].time_s <= keyframe.time_s;
    if (!again) out << tum_line(keyframe.time_s, keyframe.T_first_cam);
  }
}

/// graph.g2o of the keyframes by their steps, without loops.
void write_graph(const DriveRecord& record, std::ostream& out);

}  // namespace oneac::app
