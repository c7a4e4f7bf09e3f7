#include "read/log_view.h"

#include <mrpt/img/CImage.h>

#include <charconv>
#include <stdexcept>

namespace oneac {
namespace {

std::shared_ptr<const LogImage> image_of(const mrpt::img::CImage& image, const LogImages& images) {
  static const auto kNone = std::make_shared<const LogImage>();
  if (!image.isExternallyStored()) return kNone;
  const std::string& number = image.getExternalStorageFile();
  std::size_t index = images.size();
  std::from_chars(number.data(), number.data() + number.size(), index);
  return index < images.size() ? images[index] : kNone;
}

}  // namespace

std::vector<LogView> log_views(const RawlogRecord& record) {
  std::vector<LogView> views;
  for (const CameraView& view : camera_views(*record.observation)) {
    views.push_back({view, image_of(*view.pixels, *record.images)});
  }
  return views;
}

void check_cameras(const mrpt::obs::CObservation& observation) {
  for (const CameraView& view : camera_views(observation)) {
    if (!view.has_sound_pose()) throw std::runtime_error(damaged_pose(view));
  }
}

}  // namespace oneac
