#include "import/exif_times.h"
#include "import/image_drive.h"
#include "import/import_images.h"
#include "import/stamps.h"

#include "oneac/base/error.h"

#include <algorithm>
#include <cctype>

namespace oneac {
namespace {

namespace fs = std::filesystem;

std::vector<double> times_of(const DriveImport& options, const std::vector<fs::path>& images,
                             ImportReport& report) {
  if (options.fps) return stamps_of_fps(*options.fps, images.size());
  const fs::path table = options.source / "times.txt";
  if (fs::exists(table)) return stamps_from_table(table, images, report);
  std::vector<double> times = stamps_from_names(images);
  if (!times.empty()) {
    report.notes.emplace_back("the images are stamped with the times in their names");
    return times;
  }
  std::string fault;
  times = stamps_from_exif(images, report, fault);
  if (!times.empty()) return times;
  throw InputError(options.source.string(),
                   "nothing tells when its images were taken: there is no times.txt, their names "
                   "hold no times since 1970 in s, ms, us or ns that increase, and there is " +
                       fault,
                   "give their rate with --fps, or a times.txt with a row per image");
}

bool names_say(const fs::path& image, const char* side) {
  std::string name = image.stem().string();
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name.find(side) != std::string::npos;
}

/// Left and right images by turns would be a camera that jumps to and fro.
void require_one_camera(const std::vector<fs::path>& images, const fs::path& source) {
  const auto any = [&](const char* side) {
    return std::any_of(images.begin(), images.end(),
                       [&](const fs::path& image) { return names_say(image, side); });
  };
  if (!any("left") || !any("right")) return;
  throw InputError(source.string(), "its images are those of two cameras, left and right",
                   "move those of one of them to another folder, or use `oneac import malaga`");
}

}  // namespace

ImportReport import_image_folder(const DriveImport& options) {
  require_source_folder(options.source);
  ImportReport report;
  report.log = options.log;
  ImageDrive drive;
  drive.label = "camera";
  drive.images = list_images(options.source);
  if (drive.images.empty()) {
    throw InputError(options.source.string(), "no images in it", "give the folder of the images");
  }
  require_one_camera(drive.images, options.source);
  drive.camera = given_calibration(options, drive.images.front(), report);
  drive.T_vehicle_cam = mount_at(options.mount, height_above_road(options, report));
  drive.convention = options.convention;
  note_order(drive.images, report);
  if (!fs::exists(options.source / "times.txt")) unroll_counter(drive.images, report);
  note_orientation(drive.images, report);
  drive.times_s = times_of(options, drive.images, report);
  write_drive(drive, options.log, options.copy_images, report);
  return report;
}

}  // namespace oneac
