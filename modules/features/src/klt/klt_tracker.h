#pragma once

#include "car_mask/car_mask.h"
#include "feature_mask.h"
#include "klt_track.h"
#include "patch/patch_flow.h"
#include "point_bins.h"
#include "rematch.h"
#include "static_points.h"

#include "oneac/base/workers.h"
#include "oneac/features/ac_tracker.h"

#include <memory>
#include <optional>
#include <vector>

namespace oneac::internal {

/// Grid-balanced corners, followed coarse to fine and aligned photometrically.
///
/// Each pair is measured from the patch of the frame before, so errors do not add up in a pair; the
/// first patch of a track only guards against drift. While the camera stands, the frame before the
/// stop remains the anchor, so that creeping adds up instead of vanishing. Where tracking breaks,
/// SIFT finds the way: its matches start tracks and lead the lost ones.
class KltTracker : public AcTracker {
 public:
  KltTracker(const FeatureOptions& options, std::shared_ptr<Workers> workers);

  [[nodiscard]] std::shared_ptr<const FrameFeatures> prepare(
      const ImageView& image, const ImageView& mask = {}) const override;
  [[nodiscard]] TrackedPair advance(std::shared_ptr<const FrameFeatures> now,
                                    const MotionHint& hint) override;
  void reset() override;
  [[nodiscard]] GreyImage car_mask() const override { return car_mask_.picture(); }
  [[nodiscard]] bool knows_car() const override {
    return !options_.mask.learn || car_mask_.knows();
  }
  [[nodiscard]] bool shows_travel() const override {
    return options_.mask.learn && car_mask_.shows_travel();
  }
  [[nodiscard]] bool views_through_dirt() const override {
    return static_points_.views_through_dirt();
  }
  [[nodiscard]] bool car_mask_refused() const override { return car_mask_.is_refused(); }
  [[nodiscard]] ImageView unused() const override {
    return masked_.empty() ? unused_.view() : masked_.view();
  }

 private:
  using Matches = std::vector<std::optional<PatchMatch>>;

  /// Looks for the car in the image; tracks on what is known to be the car end.
  void learn_car(const KltFrame& now, const MotionHint& hint);
  /// Takes the masks of this image and of the one before into what is not used.
  void take_masks(const KltFrame& now);
  [[nodiscard]] bool stands(const KltFrame& now) const;
  [[nodiscard]] TrackedPair stand(const KltFrame& now);
  [[nodiscard]] Matches follow(const std::shared_ptr<const KltFrame>& now,
                               const MotionPrediction& motion);
  /// Whether hardly any track was found although both images have texture.
  [[nodiscard]] bool is_broken(const Matches& matches, const KltFrame& now) const;
  /// Starts tracks at SIFT features of the anchor that were found again, with their matches.
  void add_rematches(const std::shared_ptr<const KltFrame>& now, Matches& matches);
  [[nodiscard]] TrackedPair take(const KltFrame& now, const MotionPrediction& motion,
                                 const Matches& matches);
  /// Per track with a match, whether it still shows its first patch; those that outgrew that take
  /// another.
  [[nodiscard]] std::vector<char> which_hold(const KltFrame& now, const Matches& matches);
  [[nodiscard]] bool holds(KltTrack& track, const KltFrame& now, const PatchMatch& match) const;
  /// Neither masked by the user, in this image or in all, nor known to be the car.
  [[nodiscard]] bool usable(const KltFrame& frame, const Eigen::Vector2d& u) const;
  /// What of an image is taken by tracks.
  struct Occupancy {
    PointBins points;
    std::vector<int> in_cell;  ///< per cell of the corners
  };
  void replenish(const KltFrame& now);
  /// Corners for tracks to start at, best first; at most one per cell that has fewer than `round`.
  [[nodiscard]] std::vector<Corner> offers(const KltFrame& now, const Occupancy& taken,
                                           int round) const;
  /// Starts those whose patch can be followed, in their order.
  void start_tracks(const KltFrame& now, const std::vector<Corner>& corners);
  [[nodiscard]] int cell_px(const ImagePyramid& pyramid) const;
  [[nodiscard]] std::size_t cell_of(const KltFrame& frame, const Eigen::Vector2d& u) const;

  FeatureOptions options_;
  std::shared_ptr<Workers> workers_;
  FeatureMask mask_;
  CarMask car_mask_;
  GreyImage unused_;  ///< by both
  GreyImage masked_;  ///< by the masks of single images, too; empty without them
  Rematcher rematcher_;
  std::shared_ptr<const KltFrame> anchor_;
  std::vector<KltTrack> tracks_;  ///< oldest first
  StaticPoints static_points_;
  std::uint64_t next_id_ = 0;
  std::size_t frame_ = 0;  ///< index of the frame given last
};

}  // namespace oneac::internal
