#pragma once

#include "images/external_images.h"
#include "read/log_reader.h"
#include "read/log_view.h"

#include "oneac/observations/camera_reader.h"

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace oneac {

/// Whether the pixels of a view can be had: stored in the log, or in a file that exists.
[[nodiscard]] bool is_present(const LogView& view, ExternalImages& images);

/// A camera of the log.
struct CameraCandidate : CameraDescription {
  bool matches = false;  ///< the user's --camera
  bool present = false;  ///< an image of it has been found
  std::size_t images = 0;
  std::size_t first_record = 0;
};

/// Decides which camera of a log is meant, from the beginning of the log.
///
/// Without a wish the log must leave no choice: one sensor with images; of a stereo sensor the left
/// camera, or the right one when only its images exist. Cameras that show up later than
/// kProbeSeconds after the first image are not considered.
class CameraProbe {
 public:
  static constexpr double kProbeSeconds = 2.0;

  CameraProbe(std::string wanted, ExternalImages& images);
  void add(const RawlogRecord& record);
  /// No further record can change the outcome.
  [[nodiscard]] bool decided() const;
  /// @throws InputError when no camera is meant, several are, or none of its images exists
  [[nodiscard]] const CameraCandidate& choice(const std::filesystem::path& log) const;
  [[nodiscard]] bool has_images() const { return !candidates_.empty(); }

 private:
  void add_view(const LogView& view, const RawlogRecord& record);
  [[nodiscard]] std::vector<const CameraCandidate*> meant() const;
  [[nodiscard]] std::string names() const;

  std::string wanted_;
  ExternalImages& images_;
  std::map<std::string, CameraCandidate> candidates_;
  std::set<std::string> sensors_;
  std::optional<double> first_time_;
  double last_time_ = 0.0;
};

/// Reads the beginning of a log until the camera is clear. @throws as CameraProbe::choice does
[[nodiscard]] CameraCandidate choose_camera(const std::filesystem::path& log,
                                            const std::string& wanted, ExternalImages& images);

}  // namespace oneac
