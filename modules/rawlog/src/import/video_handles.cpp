#include "import/video_handles.h"

#include "oneac/base/error.h"

extern "C" {
#include <libavutil/display.h>
}

#include <cmath>
#include <cstdint>

namespace oneac {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& file, const std::string& fault) {
  throw InputError(file.string(), fault, "convert it, for example to MP4 with H.264");
}

/// The 3×3 matrix by which a player shows the video; null: as it is.
const std::int32_t* display_matrix(const AVStream& stream) {
#if LIBAVCODEC_VERSION_INT >= AV_VERSION_INT(60, 31, 102)
  const AVPacketSideData* side =
      av_packet_side_data_get(stream.codecpar->coded_side_data, stream.codecpar->nb_coded_side_data,
                              AV_PKT_DATA_DISPLAYMATRIX);
  return side != nullptr ? reinterpret_cast<const std::int32_t*>(side->data) : nullptr;
#else
  return reinterpret_cast<const std::int32_t*>(
      av_stream_get_side_data(&stream, AV_PKT_DATA_DISPLAYMATRIX, nullptr));
#endif
}

}  // namespace

Demuxer open_demuxer(const fs::path& file) {
  AVDictionary* options = nullptr;
  av_dict_set(&options, "protocol_whitelist", "file", 0);
  AVFormatContext* demuxer = nullptr;
  const std::string url = "file:" + fs::absolute(file).string();
  const int opened = avformat_open_input(&demuxer, url.c_str(), nullptr, &options);
  av_dict_free(&options);
  if (opened < 0) refuse(file, "it is no video that FFmpeg reads");
  Demuxer owned(demuxer);
  if (avformat_find_stream_info(demuxer, nullptr) < 0) {
    refuse(file, "it is no video that FFmpeg reads");
  }
  return owned;
}

AVStream& video_of(const AVFormatContext& demuxer, const fs::path& file) {
  for (unsigned i = 0; i < demuxer.nb_streams; ++i) {
    AVStream* stream = demuxer.streams[i];
    const bool picture = (stream->disposition & AV_DISPOSITION_ATTACHED_PIC) != 0;
    if (stream->codecpar->codec_type == AVMEDIA_TYPE_VIDEO && !picture) return *stream;
  }
  refuse(file, "it holds no video");
}

Codec open_decoder(const AVStream& stream, const fs::path& file) {
  const AVCodec* kind = avcodec_find_decoder(stream.codecpar->codec_id);
  Codec codec(kind != nullptr ? avcodec_alloc_context3(kind) : nullptr);
  if (!codec || avcodec_parameters_to_context(codec.get(), stream.codecpar) < 0) {
    refuse(file, "it is a video of a kind that FFmpeg does not decode");
  }
  codec->thread_count = 1;
  codec->pkt_timebase = stream.time_base;
  if (avcodec_open2(codec.get(), kind, nullptr) < 0) {
    refuse(file, "it is a video of a kind that FFmpeg does not decode");
  }
  return codec;
}

int quarters_of(const AVStream& stream) {
  const std::int32_t* matrix = display_matrix(stream);
  const double left_deg = matrix != nullptr ? av_display_rotation_get(matrix) : 0.0;
  if (!std::isfinite(left_deg)) return 0;
  return (static_cast<int>(std::lround(-left_deg / 90.0)) % 4 + 4) % 4;
}

}  // namespace oneac
