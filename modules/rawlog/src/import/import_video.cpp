#include "import/gps_text.h"
#include "import/image_drive.h"
#include "import/import_images.h"
#include "import/stamps.h"
#include "import/video_file.h"

#include "oneac/base/atomic_file.h"
#include "oneac/base/error.h"
#include "oneac/base/number_text.h"

#include <opencv2/imgcodecs.hpp>

#include <cmath>
#include <utility>

namespace oneac {
namespace {

namespace fs = std::filesystem;

void require_part(const VideoImport& options) {
  const bool sound =
      options.from_s >= 0.0 && std::isfinite(options.from_s) &&
      (!options.to_s || (std::isfinite(*options.to_s) && *options.to_s > options.from_s));
  if (sound) return;
  const std::string to = options.to_s ? exact_text(*options.to_s) : "the end";
  throw InputError("--from " + exact_text(options.from_s) + " --to " + to, "is no part of a video",
                   "give seconds from its start, --from before --to");
}

/// Decodes a part of a video to PNG files.
class FrameWriter {
 public:
  FrameWriter(const VideoImport& options, fs::path folder)
      : options_(options), folder_(std::move(folder)) {}

  /// What of the video is missing or damaged goes to the notes.
  /// @throws InputError when the video has no such part
  void run(ImageDrive& drive, ImportReport& report) {
    VideoFile video(options_.source);
    std::size_t frame = 0;
    bool to_its_end = true;
    for (; video.advance(); ++frame) {
      const double time = time_of(video, frame);
      if (time < options_.from_s) continue;
      to_its_end = !options_.to_s || time < *options_.to_s;
      if (!to_its_end) break;
      drive.images.push_back(write(pixels_of(video, frame), frame));
      drive.times_s.push_back(time);
    }
    if (to_its_end) note_early_end(video, frame, report);
    if (paced_ > 0) {
      report.notes.push_back("FFmpeg gives the last " + std::to_string(paced_) +
                             " frames no time: they follow at the pace of those before");
    }
    if (video.damaged() > 0) {
      report.notes.push_back("FFmpeg finds damage at " + std::to_string(video.damaged()) +
                             " of the video's frames: they and those that build on them are "
                             "smeared or left out; copy it again");
    }
    if (drive.images.size() >= 2) return;
    const bool part = options_.from_s > 0.0 || options_.to_s;
    throw InputError(options_.source.string(),
                     std::to_string(drive.images.size()) + " frames" +
                         (part ? " between --from and --to" : " can be decoded"),
                     part ? "give a part of the video with two frames at least"
                          : "copy the video again: it is cut off or damaged");
  }

 private:
  [[noreturn]] void fail(std::size_t frame, const std::string& fault,
                         const std::string& cure) const {
    throw InputError(options_.source.string() + ": frame " + std::to_string(frame), fault, cure);
  }

  /// Since the first frame [s]: a file's clock may begin at any time.
  double time_of(const VideoFile& video, std::size_t frame) {
    if (options_.fps) return static_cast<double>(frame) / *options_.fps;
    const std::optional<double> told = video.time_s();
    if (frame == 0) begin_s_ = told.value_or(0.0);
    const double time = told ? *told - begin_s_ : paced(frame);
    if (frame > 0 && !(time > last_s_)) {
      fail(frame, "its time is not later than the one before", "give the rate with --fps");
    }
    step_s_ = time - last_s_;
    last_s_ = time;
    return time;
  }

  /// An AVI tells no times of presentation, so that frames that wait for others, the last ones of
  /// H.264 and MPEG-4 with B-frames, have none: it is of one rate, which they keep.
  double paced(std::size_t frame) {
    constexpr std::size_t kMostHeld = 16;  // of H.264 and H.265
    if (frame < 2 || paced_ == kMostHeld) fail(frame, "it has no time", "give the rate with --fps");
    ++paced_;
    return last_s_ + step_s_;
  }

  cv::Mat pixels_of(VideoFile& video, std::size_t frame) {
    cv::Mat image = video.pixels();
    if (image.empty())
      fail(frame, "it cannot be decoded", "copy the video again, or cut it with --to");
    if (size_.empty()) size_ = image.size();
    if (image.size() == size_) return image;
    fail(frame, "it has " + size_text(image.size()) + " pixels, the first has " + size_text(size_),
         "cut it with --from and --to");
  }

  static std::string size_text(const cv::Size& size) {
    return std::to_string(size.width) + "x" + std::to_string(size.height);
  }

  void note_early_end(const VideoFile& video, std::size_t frames, ImportReport& report) const {
    constexpr double kSlack_s = 1.0;  // how long the last frame is shown, many files do not say
    if (video.missing_s() < kSlack_s) return;
    const std::string of = video.frames_told() > frames
                               ? " of " + std::to_string(video.frames_told()) + " frames: "
                               : " frames: ";
    report.notes.push_back(std::to_string(frames) + of + "the file ends " +
                           fixed_text(video.missing_s(), 1) +
                           " s before the time that it says, cut off or damaged");
  }

  [[nodiscard]] fs::path write(const cv::Mat& image, std::size_t frame) const {
    std::string number = std::to_string(frame);
    constexpr std::size_t kDigits = 6;
    number.insert(0, number.size() < kDigits ? kDigits - number.size() : 0, '0');
    fs::path file = folder_ / (number + ".png");
    bool written = false;
    try {
      written = cv::imwrite(file.string(), image);
    } catch (const cv::Exception&) {
    }
    if (written) return file;
    throw OutputError(file.string(), "cannot be written", "free some space");
  }

  const VideoImport& options_;
  fs::path folder_;
  cv::Size size_;                       ///< of the first frame
  double begin_s_ = 0.0;                ///< of the first frame
  double last_s_ = 0.0, step_s_ = 0.0;  ///< of the frame before, and to it
  std::size_t paced_ = 0;               ///< frames that had no time
};

std::vector<GpsRecord> read_gps(const VideoImport& options, ImportReport& report) {
  const int given = (options.nmea.empty() ? 0 : 1) + (options.gpx.empty() ? 0 : 1) +
                    (options.csv.empty() ? 0 : 1);
  if (given > 1) {
    throw InputError("--nmea, --gpx, --csv", "several are given", "give the file of one receiver");
  }
  if (!options.nmea.empty()) return read_nmea(options.nmea, report);
  if (!options.gpx.empty()) return read_gpx(options.gpx, report);
  if (!options.csv.empty()) return read_gps_csv(options.csv, report);
  return {};
}

/// Unix time [s] of the start of the video.
double start_of(const VideoImport& options, const std::vector<GpsRecord>& gps,
                ImportReport& report) {
  if (!options.start.empty()) {
    const double counted = seconds_since_1970(options.start);
    if (counted >= 0.0) return counted;
    if (const auto date = date_stamp(options.start)) return *date;
    throw InputError("--start " + options.start, "is no time since 1970",
                     "give seconds, or a date and time of UTC such as 2024-05-01T10:00:00Z");
  }
  if (gps.empty()) return kImportEpoch_s;
  report.notes.emplace_back(
      "the video is taken to begin with the first fix of the GPS: where it does not, lengths by "
      "GPS "
      "are wrong; give its begin with --start");
  return gps.front().time_s;
}

/// The fixes of the drive, and a note where there are none.
void add_gps(std::vector<GpsRecord> gps, ImageDrive& drive, ImportReport& report) {
  constexpr double kMargin_s = 1.0;  // an epoch of a slow receiver
  if (gps.empty()) return;
  for (const GpsRecord& fix : gps) {
    const bool within = fix.time_s >= drive.times_s.front() - kMargin_s &&
                        fix.time_s <= drive.times_s.back() + kMargin_s;
    if (within) drive.gps.push_back(fix);
  }
  if (!drive.gps.empty()) return;
  report.notes.push_back(
      "no fix lies within the video: it spans " + fixed_text(drive.times_s.front(), 1) + " to " +
      fixed_text(drive.times_s.back(), 1) + " s, the GPS " + fixed_text(gps.front().time_s, 1) +
      " to " + fixed_text(gps.back().time_s, 1) + " s");
}

}  // namespace

ImportReport import_video(const VideoImport& options) {
  require_part(options);
  if (options.fps) static_cast<void>(stamps_of_fps(*options.fps, 0));  // a bad rate is refused
  ImportReport report;
  report.log = options.log;
  if (options.calibration.empty()) {
    throw InputError(options.source.string(), "nothing tells the calibration of its camera",
                     "give it with --calibration FILE[:SECTION]");
  }
  ImageDrive drive;
  drive.label = "camera";
  drive.T_vehicle_cam = mount_at(options.mount, height_above_road(options, report));
  drive.convention = options.convention;
  std::vector<GpsRecord> gps = read_gps(options, report);
  const double start_s = start_of(options, gps, report);
  drive.made = std::make_shared<MadeImages>(options.log);
  FrameWriter(options, drive.made->folder()).run(drive, report);
  for (double& time : drive.times_s) time += start_s;
  drive.camera = given_calibration(options, drive.images.front(), report);
  report.notes.push_back(std::to_string(drive.images.size()) + " frames decoded to " +
                         drive.made->destination().string());
  add_gps(std::move(gps), drive, report);
  write_drive(drive, options.log, false, report);
  return report;
}

}  // namespace oneac
