#include "import/gps_text.h"
#include "import/image_drive.h"
#include "import/import_images.h"
#include "import/stamps.h"

#include "oneac/base/atomic_file.h"
#include "oneac/base/error.h"
#include "oneac/base/input_file.h"
#include "oneac/base/number_text.h"

#include <dlfcn.h>

#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include <cmath>
#include <cstdarg>
#include <utility>

namespace oneac {
namespace {

namespace fs = std::filesystem;
namespace logging = cv::utils::logging;

constexpr double kMillisecond = 1e-3;

/// FFmpeg and OpenCV print what they think of a file; here what is wrong is said once, by an
/// exception. OpenCV has no switch for FFmpeg and sets its level at each opening, but not its
/// callback.
class SilentVideo {
 public:
  SilentVideo() : usual_level_(logging::setLogLevel(logging::LOG_LEVEL_SILENT)) {
    set_callback([](void*, int, const char*, va_list) {});
  }
  ~SilentVideo() {
    logging::setLogLevel(usual_level_);
    if (void* usual = ::dlsym(RTLD_DEFAULT, "av_log_default_callback")) {
      set_callback(reinterpret_cast<Callback>(usual));
    }
  }
  SilentVideo(const SilentVideo&) = delete;
  SilentVideo& operator=(const SilentVideo&) = delete;

 private:
  using Callback = void (*)(void*, int, const char*, va_list);

  static void set_callback(Callback callback) {
    using Setter = void (*)(Callback);
    if (void* setter = ::dlsym(RTLD_DEFAULT, "av_log_set_callback")) {
      reinterpret_cast<Setter>(setter)(callback);
    }
  }

  logging::LogLevel usual_level_;
};

/// A video's frames, one at a time.
class Video {
 public:
  explicit Video(const fs::path& file) : file_(file) {
    if (const std::string fault = fault_of_file(file); !fault.empty()) {
      throw InputError(file.string(), fault, "give the file of a video");
    }
    // Only what is in the file: a name like "img_%04d.png" is no list of images here.
    if (!capture_.open(file.string(), cv::CAP_FFMPEG)) {
      throw InputError(file.string(), "it is no video that FFmpeg reads",
                       "convert it, for example to MP4 with H.264");
    }
  }
  [[nodiscard]] bool advance() { return capture_.grab(); }
  /// Of the frame that advance() has reached, since the start of the video [s].
  [[nodiscard]] double time_s() const { return kMillisecond * capture_.get(cv::CAP_PROP_POS_MSEC); }
  /// @throws InputError for a frame that cannot be decoded
  [[nodiscard]] cv::Mat pixels(std::size_t frame) {
    cv::Mat image;
    if (capture_.retrieve(image) && !image.empty()) return image;
    throw InputError(file_.string() + ": frame " + std::to_string(frame), "it cannot be decoded",
                     "copy the video again, or cut it with --to");
  }

 private:
  fs::path file_;
  SilentVideo silent_;
  cv::VideoCapture capture_;
};

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
  explicit FrameWriter(const VideoImport& options)
      : options_(options),
        folder_(options.log.parent_path() / (options.log.stem().string() + "_Images")) {
    require_writable_folder(folder_);
  }

  /// @throws InputError when the video has no such part
  void run(ImageDrive& drive) {
    Video video(options_.source);
    for (std::size_t frame = 0; video.advance(); ++frame) {
      const double time = options_.fps ? static_cast<double>(frame) / *options_.fps
                                       : time_of(video.time_s(), frame);
      require_later(time, frame);
      if (time < options_.from_s) continue;
      if (options_.to_s && time >= *options_.to_s) break;
      drive.images.push_back(write(video.pixels(frame), frame));
      drive.times_s.push_back(time);
    }
    if (drive.images.size() >= 2) return;
    throw InputError(options_.source.string(),
                     std::to_string(drive.images.size()) + " frames between --from and --to",
                     "give a part of the video with two frames at least");
  }
  /// Frames at the end whose time had to be guessed.
  [[nodiscard]] std::size_t paced() const { return paced_; }

 private:
  /// OpenCV has no time, but zero, for the frames that the decoder still holds at the end of the
  /// file, the last ones of every H.264 with B-frames: they follow at the pace of those before. In
  /// an AVI it counts from what the decoder holds back at the start: from the first frame here.
  [[nodiscard]] double time_of(double told_s, std::size_t frame) {
    constexpr std::size_t kMostHeld = 16;  // of H.264 and H.265
    if (frame == 0) begin_s_ = told_s;
    if (told_s != 0.0 || frame < 2 || paced_ == kMostHeld) return told_s - begin_s_;
    ++paced_;
    return last_s_ + step_s_;
  }

  void require_later(double time, std::size_t frame) {
    const bool later = frame == 0 || time > last_s_;
    step_s_ = time - last_s_;
    last_s_ = time;
    if (later && std::isfinite(time)) return;
    throw InputError(options_.source.string() + ": frame " + std::to_string(frame),
                     "its time is not later than the one before", "give the rate with --fps");
  }

  [[nodiscard]] fs::path write(const cv::Mat& image, std::size_t frame) const {
    std::string number = std::to_string(frame);
    constexpr std::size_t kDigits = 6;
    number.insert(0, number.size() < kDigits ? kDigits - number.size() : 0, '0');
    const fs::path file = folder_ / (number + ".png");
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
  double begin_s_ = 0.0;                ///< of the first frame
  double last_s_ = 0.0, step_s_ = 0.0;  ///< of the frame before, and to it
  std::size_t paced_ = 0;
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
  FrameWriter frames(options);
  frames.run(drive);
  for (double& time : drive.times_s) time += start_s;
  drive.camera = given_calibration(options, drive.images.front(), report);
  report.notes.push_back(std::to_string(drive.images.size()) + " frames decoded to " +
                         drive.images.front().parent_path().string());
  if (frames.paced() > 0) {
    report.notes.push_back("FFmpeg gives the last " + std::to_string(frames.paced()) +
                           " frames no time: they follow at the pace of those before");
  }
  add_gps(std::move(gps), drive, report);
  for (fs::path& image : drive.images) image = fs::absolute(image);
  write_drive(drive, options.log, false, report);
  return report;
}

}  // namespace oneac
