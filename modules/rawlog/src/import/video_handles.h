#pragma once

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libswscale/swscale.h>
}

#include <filesystem>
#include <memory>
#include <string>

namespace oneac {

struct CloseDemuxer {
  void operator()(AVFormatContext* demuxer) const { avformat_close_input(&demuxer); }
};
struct FreeCodec {
  void operator()(AVCodecContext* codec) const { avcodec_free_context(&codec); }
};
struct FreePacket {
  void operator()(AVPacket* packet) const { av_packet_free(&packet); }
};
struct FreeFrame {
  void operator()(AVFrame* frame) const { av_frame_free(&frame); }
};
struct FreeScaler {
  void operator()(SwsContext* scaler) const { sws_freeContext(scaler); }
};
using Demuxer = std::unique_ptr<AVFormatContext, CloseDemuxer>;
using Codec = std::unique_ptr<AVCodecContext, FreeCodec>;
using Packet = std::unique_ptr<AVPacket, FreePacket>;
using Frame = std::unique_ptr<AVFrame, FreeFrame>;
using Scaler = std::unique_ptr<SwsContext, FreeScaler>;

/// A colon in a name is no protocol, and nothing but files is reached.
/// @throws InputError for what is no file that FFmpeg reads
[[nodiscard]] Demuxer open_demuxer(const std::filesystem::path& file);

/// The first video; a picture of an album is none. @throws InputError when there is none
[[nodiscard]] AVStream& video_of(const AVFormatContext& demuxer, const std::filesystem::path& file);

/// On one thread: with several, FFmpeg conceals damage in another way for each number of them. PNG
/// files take longer to write than frames to decode.
/// @throws InputError for a kind of video that FFmpeg does not decode
[[nodiscard]] Codec open_decoder(const AVStream& stream, const std::filesystem::path& file);

/// Clockwise quarters of a turn by which a player shows the video, 0 to 3.
[[nodiscard]] int quarters_of(const AVStream& stream);

}  // namespace oneac
