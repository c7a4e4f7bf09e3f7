#include "video_maker.h"

#include "import/video_handles.h"

#include <cstdint>
#include <memory>
#include <stdexcept>

namespace oneac::test {
namespace {

constexpr int kWidth = 64, kHeight = 48;

void require(bool sound) {
  if (!sound) throw std::runtime_error("FFmpeg does not write the video of a test");
}

struct CloseMuxer {
  void operator()(AVFormatContext* muxer) const {
    avio_closep(&muxer->pb);
    avformat_free_context(muxer);
  }
};
class VideoMaker {
 public:
  explicit VideoMaker(const std::filesystem::path& file) {
    AVFormatContext* muxer = nullptr;
    require(avformat_alloc_output_context2(&muxer, nullptr, nullptr, file.c_str()) >= 0);
    muxer_.reset(muxer);
    const AVCodec* kind = avcodec_find_encoder(AV_CODEC_ID_MPEG4);
    codec_.reset(avcodec_alloc_context3(kind));
    codec_->width = kWidth;
    codec_->height = kHeight;
    codec_->pix_fmt = AV_PIX_FMT_YUV420P;
    // An AVI counts frames: ten a second.
    codec_->time_base = {1, file.extension() == ".avi" ? 10 : 1000};
    codec_->max_b_frames = 2;
    codec_->bit_rate = 2000000;
    codec_->thread_count = 1;
    if ((muxer->oformat->flags & AVFMT_GLOBALHEADER) != 0) {
      codec_->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    }
    require(avcodec_open2(codec_.get(), kind, nullptr) >= 0);
    stream_ = avformat_new_stream(muxer, nullptr);
    stream_->time_base = codec_->time_base;
    require(avcodec_parameters_from_context(stream_->codecpar, codec_.get()) >= 0);
    require(avio_open(&muxer->pb, file.c_str(), AVIO_FLAG_WRITE) >= 0);
    require(avformat_write_header(muxer, nullptr) >= 0);
    frame_->format = codec_->pix_fmt;
    frame_->width = kWidth;
    frame_->height = kHeight;
    require(av_frame_get_buffer(frame_.get(), 0) >= 0);
  }

  void add(int index, int time_ms) {
    require(av_frame_make_writable(frame_.get()) >= 0);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const unsigned cell = static_cast<unsigned>((x + 2 * index) / 8 + 31 * (y / 8));
        frame_->data[0][y * frame_->linesize[0] + x] =
            static_cast<std::uint8_t>(30U + cell * 2654435761U % 199U);
        frame_->data[1][y / 2 * frame_->linesize[1] + x / 2] = 128;
        frame_->data[2][y / 2 * frame_->linesize[2] + x / 2] = 128;
      }
    }
    frame_->pts = av_rescale(time_ms, codec_->time_base.den, 1000);
    send(frame_.get());
  }

  void finish() {
    send(nullptr);
    require(av_write_trailer(muxer_.get()) >= 0);
  }

 private:
  void send(const AVFrame* frame) {
    require(avcodec_send_frame(codec_.get(), frame) >= 0);
    while (avcodec_receive_packet(codec_.get(), packet_.get()) >= 0) {
      packet_->stream_index = 0;
      packet_->duration =
          codec_->time_base.den / 10;  // without, MP4 says that it ends with the last frame's begin
      av_packet_rescale_ts(packet_.get(), codec_->time_base, stream_->time_base);
      require(av_interleaved_write_frame(muxer_.get(), packet_.get()) >= 0);
    }
  }

  std::unique_ptr<AVFormatContext, CloseMuxer> muxer_;
  Codec codec_;
  Packet packet_{av_packet_alloc()};
  Frame frame_{av_frame_alloc()};
  AVStream* stream_ = nullptr;
};

}  // namespace

void write_video(const std::filesystem::path& file, const std::vector<int>& times_ms) {
  VideoMaker maker(file);
  for (std::size_t i = 0; i < times_ms.size(); ++i) maker.add(static_cast<int>(i), times_ms[i]);
  maker.finish();
}

}  // namespace oneac::test
