#include "worst_frames.h"

#include "oneac/base/number_text.h"
#include "oneac/evaluation/statistics.h"
#include "oneac/features/ac_tracker.h"
#include "oneac/geometry/angles.h"
#include "oneac/geometry/essential.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace oneac::app {
namespace {

constexpr std::size_t kApart = 5;          // frames: half a second at the usual 10 Hz
constexpr double kFewInliers = 1.0 / 3.0;  // of the median: below, something is in the way

/// Takes the first `share` of the candidates that are not chosen yet, the worst first.
class Chooser {
 public:
  explicit Chooser(std::size_t count) : left_(count) {}

  /// @param worse  strict weak order of frames; ties go to the earlier frame
  template <class Worse, class Reason>
  void take(std::vector<std::size_t> frames, std::size_t share, Worse&& worse, Reason&& reason) {
    std::stable_sort(frames.begin(), frames.end(), worse);
    for (const std::size_t frame : frames) {
      if (left_ == 0 || share == 0) return;
      if (is_near(frame)) continue;
      taken_.insert({frame, reason(frame)});
      --left_;
      --share;
    }
  }
  [[nodiscard]] std::vector<WorstFrame> result() const {
    std::vector<WorstFrame> frames;
    for (const auto& [frame, reason] : taken_) frames.push_back({frame, reason, true});
    return frames;
  }

 private:
  /// Neighbours look alike and show the same trouble.
  [[nodiscard]] bool is_near(std::size_t frame) const {
    const auto next = taken_.lower_bound(frame < kApart ? 0 : frame - kApart + 1);
    return next != taken_.end() && next->first < frame + kApart;
  }

  std::size_t left_;
  std::map<std::size_t, std::string> taken_;
};

std::string inliers_text(const StepResult& step) {
  return std::to_string(step.inliers) + " inliers of " + std::to_string(step.acs);
}

/// In units of what counts as a wrong basin.
double badness(const PairError& error) {
  return std::max(error.rotation / kBadRotation, error.direction.value_or(0.0) / kBadDirection);
}

std::string error_text(const PairError& error) {
  std::string text = "rotation off by " + fixed_text(error.rotation / kDegree, 3) + "°";
  if (error.direction) text += ", direction by " + fixed_text(*error.direction / kDegree, 2) + "°";
  return text;
}

/// Errors of the steps in a wrong basin, by their frame.
std::map<std::size_t, PairError> bad_errors(const DriveRecord& record,
                                            const RunEvaluation& evaluation) {
  std::map<std::size_t, PairError> errors;
  if (!evaluation.against_poses) return errors;
  std::map<std::size_t, PairError> of_index;
  for (const PairError& error : evaluation.against_poses->pairs) {
    if (error.is_bad()) of_index[error.index2] = error;
  }
  std::size_t i = 0;
  for (const FrameResult& frame : record.frames) {
    const auto found = frame.step ? of_index.find(frame.step->index2) : of_index.end();
    if (found != of_index.end()) errors[i] = found->second;
    ++i;
  }
  return errors;
}

/// Distance from the motion in normalised units: of the epipolar line, or, of a camera that did not
/// move, of the point that the rotation predicts.
double distance(const RelativePose& pose, const AffineCorrespondence& ac) {
  if (pose.t.norm() > 0.0) return std::abs(sampson_distance(essential_matrix(pose), ac.x1, ac.x2));
  const Eigen::Vector3d ray = pose.R * ac.x1.homogeneous();
  return (ray.hnormalized() - ac.x2).norm();
}

MotionHint hint_of(const DriveRecord& record, const StepResult& step, const PinholeCamera& camera) {
  MotionHint hint;
  hint.camera = camera;
  hint.R_level_cam = levelling_rotation(record.tilt);
  hint.T_2_1 = step.pose;
  hint.scaled = step.metric && record.camera_height > 0.0;
  if (hint.scaled) hint.T_2_1->t /= record.camera_height;
  return hint;
}

Overlay overlay_of(const DriveRecord& record, const RunOptions& options, const StepResult& step,
                   const CameraFrame& first, const CameraFrame& second) {
  const auto tracker = make_tracker(options.front_end.features);
  const MotionHint hint = hint_of(record, step, first.camera);
  (void)tracker->advance(tracker->prepare(first.image.view(), first.mask.view()), hint);
  const TrackedPair pair =
      tracker->advance(tracker->prepare(second.image.view(), second.mask.view()), hint);
  Overlay overlay{second.image.width(), second.image.height(), jpeg_of(second.image.view()), {}};
  const double bound = options.front_end.consensus.threshold_px / second.camera.focal_px();
  for (const Correspondence& ac : pair.correspondences) {
    const double r = distance(step.pose, normalise(ac, first.camera, second.camera));
    overlay.marks.push_back({ac.x1, ac.x2, ac.A, r <= bound ? 0.0 : 1.0});
  }
  return overlay;
}

}  // namespace

std::vector<WorstFrame> worst_frames(const DriveRecord& record, const RunEvaluation& evaluation,
                                     std::size_t count) {
  std::vector<std::size_t> steps, predicted, few;
  std::vector<double> inliers, of_frame;  // of the steps; of all frames
  for (const FrameResult& frame : record.frames) {
    const std::size_t i = of_frame.size();
    of_frame.push_back(frame.step ? static_cast<double>(frame.step->inliers) : 0.0);
    if (!frame.step) continue;
    steps.push_back(i);
    inliers.push_back(of_frame.back());
    if (frame.step->status == StepStatus::kPredicted) predicted.push_back(i);
  }
  if (steps.empty()) return {};
  const double usual = percentile(std::move(inliers), 50.0);
  std::copy_if(steps.begin(), steps.end(), std::back_inserter(few),
               [&](std::size_t i) { return of_frame[i] < kFewInliers * usual; });
  const auto fewer = [&](std::size_t a, std::size_t b) { return of_frame[a] < of_frame[b]; };
  const auto inliers_of = [&](std::size_t i) { return inliers_text(*record.frames[i].step); };
  std::map<std::size_t, PairError> errors = bad_errors(record, evaluation);
  std::vector<std::size_t> judged;
  for (const auto& [frame, error] : errors) judged.push_back(frame);
  Chooser chooser(count);
  chooser.take(predicted, count / 3, fewer, [&](std::size_t i) {
    return "the images did not carry the step, " + inliers_of(i);
  });
  chooser.take(
      judged, count / 3,
      [&](std::size_t a, std::size_t b) { return badness(errors[a]) > badness(errors[b]); },
      [&](std::size_t i) { return "far from the reference: " + error_text(errors[i]); });
  chooser.take(few, count, fewer, [&](std::size_t i) { return "few inliers: " + inliers_of(i); });
  if (!chooser.result().empty()) return chooser.result();
  const std::size_t least = *std::min_element(steps.begin(), steps.end(), fewer);
  return {{least, "the fewest inliers of the drive: " + inliers_of(least), false}};
}

std::optional<GreyImage> read_image(const RunOptions& options, std::size_t index) {
  try {
    RawlogSource source(options.source.for_log(options.log));
    for (auto ticket = source.next(); ticket; ticket = source.next()) {
      if (ticket->index == index) return source.load(*ticket).image;
    }
  } catch (const std::exception&) {
    // The log changed under the run, or the images went: the report goes without.
  }
  return std::nullopt;
}

std::vector<FramePicture> draw_frames(const DriveRecord& record, const RunOptions& options,
                                      const std::vector<WorstFrame>& frames) {
  std::set<std::size_t> wanted;
  for (const WorstFrame& frame : frames) {
    const StepResult step = *record.frames[frame.frame].step;
    wanted.insert({step.index1, step.index2});
  }
  std::vector<FramePicture> pictures;
  try {
    RawlogSource source(options.source.for_log(options.log));
    std::map<std::size_t, FrameTicket> tickets;
    while (tickets.size() < wanted.size()) {
      auto ticket = source.next();
      if (!ticket) break;
      if (wanted.count(ticket->index) == 1) tickets.emplace(ticket->index, *ticket);
    }
    for (const WorstFrame& frame : frames) {
      const StepResult step = *record.frames[frame.frame].step;
      pictures.push_back(
          {frame, overlay_of(record, options, step, source.load(tickets.at(step.index1)),
                             source.load(tickets.at(step.index2)))});
    }
  } catch (const std::exception&) {
    // The log changed under the run, or the images went: the pictures so far are the report's.
  }
  return pictures;
}

}  // namespace oneac::app
