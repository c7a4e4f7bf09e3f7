#include "import/video_file.h"

#include "import/video_handles.h"

#include "oneac/base/error.h"
#include "oneac/base/input_file.h"

extern "C" {
#include <libavutil/log.h>
}

#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstdint>
#include <cstring>
#include <string>

namespace oneac {
namespace {

namespace fs = std::filesystem;

/// Whether FFmpeg has called something an error since this was set to false; of the thread that
/// decodes, as FFmpeg has one listener for the whole process.
thread_local bool has_complained = false;

/// FFmpeg prints what it thinks of a file; here what is wrong is said once, by an exception or a
/// note.
class SilentFfmpeg {
 public:
  SilentFfmpeg() {
    av_log_set_callback([](void*, int level, const char*, va_list) {
      has_complained = has_complained || level <= AV_LOG_ERROR;
    });
  }
  ~SilentFfmpeg() { av_log_set_callback(av_log_default_callback); }
  SilentFfmpeg(const SilentFfmpeg&) = delete;
  SilentFfmpeg& operator=(const SilentFfmpeg&) = delete;
};

cv::Mat turned(const cv::Mat& image, int quarters) {
  if (quarters == 0) return image;
  cv::Mat result;
  constexpr std::array<int, 3> kTurns{cv::ROTATE_90_CLOCKWISE, cv::ROTATE_180,
                                      cv::ROTATE_90_COUNTERCLOCKWISE};
  cv::rotate(image, result, kTurns.at(static_cast<std::size_t>(quarters - 1)));
  return result;
}

}  // namespace

class VideoFile::Decoder {
 public:
  explicit Decoder(const fs::path& file)
      : demuxer_(open_demuxer(file)),
        stream_(&video_of(*demuxer_, file)),
        codec_(open_decoder(*stream_, file)),
        packet_(av_packet_alloc()),
        frame_(av_frame_alloc()),
        bgr_(av_frame_alloc()),
        quarters_(quarters_of(*stream_)) {}

  bool advance() {
    for (;;) {
      const int result =
          decode([this] { return avcodec_receive_frame(codec_.get(), frame_.get()); });
      if (result == AVERROR_EOF) return false;
      if (result == 0) return true;
      send_packet();
    }
  }

  [[nodiscard]] std::optional<double> time_s() const {
    if (frame_->best_effort_timestamp == AV_NOPTS_VALUE) return std::nullopt;
    return seconds(frame_->best_effort_timestamp, *stream_);
  }

  cv::Mat pixels() {
    const int width = frame_->width, height = frame_->height;
    const auto format = static_cast<AVPixelFormat>(frame_->format);
    scaler_.reset(sws_getCachedContext(scaler_.release(), width, height, format, width, height,
                                       AV_PIX_FMT_BGR24, SWS_BICUBIC, nullptr, nullptr, nullptr));
    av_frame_unref(bgr_.get());
    bgr_->format = AV_PIX_FMT_BGR24;
    bgr_->width = width;
    bgr_->height = height;
    if (!scaler_ || av_frame_get_buffer(bgr_.get(), 0) < 0) return {};
    sws_scale(scaler_.get(), frame_->data, frame_->linesize, 0, height, bgr_->data, bgr_->linesize);
    const cv::Mat image(height, width, CV_8UC3, bgr_->data[0],
                        static_cast<std::size_t>(bgr_->linesize[0]));
    return turned(image, quarters_);
  }

  [[nodiscard]] std::size_t damaged() const { return damaged_ + (is_hurt_ ? 1U : 0U); }
  [[nodiscard]] std::size_t frames_told() const {
    return static_cast<std::size_t>(std::max<std::int64_t>(0, stream_->nb_frames));
  }
  [[nodiscard]] double missing_s() const {
    if (stream_->duration != AV_NOPTS_VALUE) {
      const std::int64_t start = stream_->start_time == AV_NOPTS_VALUE ? 0 : stream_->start_time;
      // Of a cut AVI, FFmpeg shortens the duration to what is there, and keeps the count.
      const bool avi = std::strcmp(demuxer_->iformat->name, "avi") == 0;
      const std::int64_t told =
          avi ? std::max(stream_->duration, stream_->nb_frames) : stream_->duration;
      return std::max(0.0, seconds(start + told, *stream_) - end_s_);
    }
    const bool told = demuxer_->duration != AV_NOPTS_VALUE &&
                      demuxer_->duration_estimation_method != AVFMT_DURATION_FROM_BITRATE;
    if (!told) return 0.0;
    const std::int64_t start = demuxer_->start_time == AV_NOPTS_VALUE ? 0 : demuxer_->start_time;
    return std::max(0.0,
                    static_cast<double>(start + demuxer_->duration) / AV_TIME_BASE - any_end_s_);
  }

 private:
  static double seconds(std::int64_t time, const AVStream& stream) {
    return av_q2d(stream.time_base) * static_cast<double>(time);
  }

  /// A call of the decoder: where it fails, or FFmpeg complains, the packet in work is damaged.
  template <class Call>
  int decode(const Call& call) {
    has_complained = false;
    const int result = call();
    const bool failed = result < 0 && result != AVERROR(EAGAIN) && result != AVERROR_EOF;
    is_hurt_ = is_hurt_ || failed || has_complained;
    return result;
  }

  /// Gives the decoder what follows in the file; at its end, word of that.
  void send_packet() {
    damaged_ += is_hurt_ ? 1U : 0U;
    is_hurt_ = false;
    while (av_read_frame(demuxer_.get(), packet_.get()) >= 0) {
      const bool mine = packet_->stream_index == stream_->index;
      note_end(mine);
      if (mine) decode([this] { return avcodec_send_packet(codec_.get(), packet_.get()); });
      av_packet_unref(packet_.get());
      if (mine) return;
    }
    avcodec_send_packet(codec_.get(), nullptr);
  }

  void note_end(bool mine) {
    const std::int64_t begin = packet_->pts == AV_NOPTS_VALUE ? packet_->dts : packet_->pts;
    if (begin == AV_NOPTS_VALUE) return;
    const AVStream& stream = *demuxer_->streams[packet_->stream_index];
    const double end_s = seconds(begin + packet_->duration, stream);
    any_end_s_ = std::max(any_end_s_, end_s);
    if (mine) end_s_ = std::max(end_s_, end_s);
  }

  SilentFfmpeg silent_;
  Demuxer demuxer_;
  AVStream* stream_;
  Codec codec_;
  Packet packet_;
  Frame frame_, bgr_;
  Scaler scaler_;
  int quarters_;
  std::size_t damaged_ = 0;               ///< packets before the one in work
  bool is_hurt_ = false;                  ///< the packet in work
  double end_s_ = 0.0, any_end_s_ = 0.0;  ///< of what was read: of the video, of all in the file
};

VideoFile::VideoFile(const fs::path& file) {
  if (const std::string fault = fault_of_file(file); !fault.empty()) {
    throw InputError(file.string(), fault, "give the file of a video");
  }
  decoder_ = std::make_unique<Decoder>(file);
}

VideoFile::~VideoFile() = default;

bool VideoFile::advance() {
  return decoder_->advance();
}

std::optional<double> VideoFile::time_s() const {
  return decoder_->time_s();
}

cv::Mat VideoFile::pixels() {
  return decoder_->pixels();
}

std::size_t VideoFile::damaged() const {
  return decoder_->damaged();
}

std::size_t VideoFile::frames_told() const {
  return decoder_->frames_told();
}

double VideoFile::missing_s() const {
  return decoder_->missing_s();
}

}  // namespace oneac
