#pragma once

#include <opencv2/core.hpp>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>

namespace oneac {

/// Frames of a video in the order in which they are shown, decoded by FFmpeg on one thread: the
/// same pixels and times on every machine, and each frame with the time that the file gives it.
class VideoFile {
 public:
  /// @throws InputError for a file that is not there or holds no video that FFmpeg decodes
  explicit VideoFile(const std::filesystem::path& file);
  ~VideoFile();
  VideoFile(const VideoFile&) = delete;
  VideoFile& operator=(const VideoFile&) = delete;

  /// Decodes the next frame. @return false at the end of the file
  [[nodiscard]] bool advance();
  /// Of the frame that advance() has reached, by the file's clock [s]; empty: the file has none.
  [[nodiscard]] std::optional<double> time_s() const;
  /// The same frame in BGR, turned as the file says; valid until the next call.
  /// @return empty where its format cannot be converted
  [[nodiscard]] cv::Mat pixels();

  /// Frames at which FFmpeg complained, or that it could not decode at all, so far.
  [[nodiscard]] std::size_t damaged() const;
  /// Frames that the file says it has; 0: it does not say.
  [[nodiscard]] std::size_t frames_told() const;
  /// How much earlier than it says the file has ended [s], once advance() has; 0: it does not say.
  [[nodiscard]] double missing_s() const;

 private:
  class Decoder;
  std::unique_ptr<Decoder> decoder_;
};

}  // namespace oneac
