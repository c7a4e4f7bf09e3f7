#pragma once

#include "oneac/comparison/pair_reference.h"
#include "oneac/features/ac_tracker.h"
#include "oneac/features/feature_options.h"
#include "oneac/geometry/camera_frame.h"
#include "oneac/rawlog/rawlog_source.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace oneac {

/// The correspondences of two consecutive selected images.
struct PairAcs {
  std::vector<AffineCorrespondence> acs;  ///< normalised
  PinholeCamera camera;                   ///< of the second image
};

/// The extractor of the options, on two images by themselves: what a tracker remembers of a drive
/// would make a pair's correspondences depend on the pairs before it, and so on the shard.
class PairExtractor {
 public:
  /// @throws std::invalid_argument for a name or option that is not valid
  explicit PairExtractor(const FeatureOptions& options);

  /// Thread-safe. @pre the image is not empty
  /// @param mask  as of AcTracker::prepare()
  [[nodiscard]] std::shared_ptr<const FrameFeatures> prepare(const ImageView& image,
                                                             const ImageView& mask) const;
  /// In pixels. Thread-safe.
  [[nodiscard]] std::vector<AffineCorrespondence> correspond(
      std::shared_ptr<const FrameFeatures> first, std::shared_ptr<const FrameFeatures> second,
      const PinholeCamera& camera) const;

 private:
  FeatureOptions options_;
  std::unique_ptr<AcTracker> prepares_;
};

/// One image of a stream: its features are made once, by whoever needs them first.
class StreamImage {
 public:
  StreamImage(const RawlogSource& source, const PairExtractor& extractor, FrameTicket ticket);

  [[nodiscard]] ImageMoment moment() const { return {ticket_.index, ticket_.time_s}; }
  /// Thread-safe. @throws InputError naming an image that cannot be decoded
  [[nodiscard]] std::shared_ptr<const FrameFeatures> features();
  /// @pre features() was called
  [[nodiscard]] const PinholeCamera& camera() const { return camera_; }

 private:
  const RawlogSource& source_;
  const PairExtractor& extractor_;
  FrameTicket ticket_;
  std::mutex mutex_;
  std::shared_ptr<const FrameFeatures> features_;
  PinholeCamera camera_;
};

/// Two consecutive images, nothing decoded yet.
struct StreamPair {
  std::size_t ordinal = 0;
  std::shared_ptr<StreamImage> first;
  std::shared_ptr<StreamImage> second;

  /// Decodes what is not decoded yet, detects, matches. Thread-safe.
  [[nodiscard]] PairAcs correspond(const PairExtractor& extractor) const;
};

/// What one pass over a log tells, which decodes as good as no image.
struct LogScan {
  std::vector<ImageMoment> images;  ///< selected, present, in time order, none a repeated one
  std::set<std::size_t> repeated;   ///< indices of images with the pixels of the one before
  std::string first_repeated;       ///< name of the first of them
  Eigen::Isometry3d T_vehicle_cam = CameraFrame::forward_looking_mount();
  VehicleReference vehicle;
  std::string damage;  ///< one line when the log ends badly, else ""
  /// Of stamps and sizes of the images, and of the pixels of the first: another drive has another.
  std::string content;

  [[nodiscard]] std::size_t pairs() const { return images.empty() ? 0 : images.size() - 1; }
};
/// Images are compared where they take as many bytes as the one before, as repeated ones do.
[[nodiscard]] LogScan scan_log(const SourceOptions& options);

/// Streams the pairs of a log, in order.
class PairStream {
 public:
  /// @param scan  of the same log; must outlive this
  PairStream(const SourceOptions& options, const LogScan& scan, const PairExtractor& extractor);
  [[nodiscard]] std::optional<StreamPair> next();

 private:
  RawlogSource source_;
  const LogScan& scan_;
  const PairExtractor& extractor_;
  std::shared_ptr<StreamImage> last_;
  std::size_t ordinal_ = 0;
};

}  // namespace oneac
