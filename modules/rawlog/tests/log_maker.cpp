#include "log_maker.h"

#include <mrpt/core/Clock.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/serialization/CArchive.h>
#include <zlib.h>
#include <zstd.h>

#include <fstream>
#include <stdexcept>

namespace oneac::test {
namespace {

std::string gzipped(const std::string& plain) {
  z_stream z{};
  constexpr int kGzip = 15 + 16;
  if (deflateInit2(&z, 6, Z_DEFLATED, kGzip, 8, Z_DEFAULT_STRATEGY) != Z_OK) {
    throw std::runtime_error("deflateInit2");
  }
  std::string out(deflateBound(&z, plain.size()) + 64, '\0');
  z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(plain.data()));
  z.avail_in = static_cast<uInt>(plain.size());
  z.next_out = reinterpret_cast<Bytef*>(out.data());
  z.avail_out = static_cast<uInt>(out.size());
  if (deflate(&z, Z_FINISH) != Z_STREAM_END) throw std::runtime_error("deflate");
  out.resize(z.total_out);
  deflateEnd(&z);
  return out;
}

std::string zstd_packed(const std::string& plain) {
  std::string out(ZSTD_compressBound(plain.size()), '\0');
  const std::size_t size = ZSTD_compress(out.data(), out.size(), plain.data(), plain.size(), 3);
  if (ZSTD_isError(size) != 0U) throw std::runtime_error("ZSTD_compress");
  out.resize(size);
  return out;
}

mrpt::Clock::time_point time_of(double seconds) {
  return mrpt::Clock::fromDouble(kStart + seconds);
}

}  // namespace

std::string packed(const Objects& objects, Packing packing) {
  mrpt::io::CMemoryStream memory;
  auto archive = mrpt::serialization::archiveFrom<mrpt::io::CStream>(memory);
  for (const auto& object : objects) archive << *object;
  const std::string plain(static_cast<const char*>(memory.getRawBufferData()),
                          static_cast<std::size_t>(memory.getPosition()));
  return packed_bytes(plain, packing);
}

std::string packed_bytes(const std::string& plain, Packing packing) {
  if (packing == Packing::gzip) return gzipped(plain);
  return packing == Packing::zstd ? zstd_packed(plain) : plain;
}

void write_bytes(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

void write_log(const std::filesystem::path& file, const Objects& objects, Packing packing) {
  write_bytes(file, packed(objects, packing));
}

cv::Mat ramp(int level) {
  cv::Mat image(kHeight, kWidth, CV_8U);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u)
      image.at<std::uint8_t>(v, u) = cv::saturate_cast<std::uint8_t>(level + u);
  }
  return image;
}

mrpt::img::TCamera calibration() {
  mrpt::img::TCamera camera;
  camera.ncols = kWidth;
  camera.nrows = kHeight;
  camera.setIntrinsicParamsFromValues(50, 50, 32, 24);
  return camera;
}

mrpt::obs::CObservationImage::Ptr stored_image(const std::string& label, double seconds,
                                               const cv::Mat& pixels) {
  auto image = external_image(label, seconds, "unused");
  image->image = mrpt::img::CImage(pixels, mrpt::img::DEEP_COPY);
  return image;
}

mrpt::obs::CObservationImage::Ptr external_image(const std::string& label, double seconds,
                                                 const std::string& file) {
  auto image = mrpt::obs::CObservationImage::Create();
  image->sensorLabel = label;
  image->timestamp = time_of(seconds);
  image->cameraParams = calibration();
  image->image.setExternalStorage(file);
  return image;
}

mrpt::obs::CObservationStereoImages::Ptr external_pair(const std::string& label, double seconds,
                                                       const std::string& name) {
  auto pair = mrpt::obs::CObservationStereoImages::Create();
  pair->sensorLabel = label;
  pair->timestamp = time_of(seconds);
  pair->leftCamera = calibration();
  pair->rightCamera = calibration();
  pair->hasImageRight = true;
  pair->imageLeft.setExternalStorage(name + "_left.png");
  pair->imageRight.setExternalStorage(name + "_right.png");
  pair->rightCameraPose = mrpt::poses::CPose3DQuat(mrpt::poses::CPose3D(0.12, 0, 0, 0, 0, 0));
  return pair;
}

mrpt::obs::CObservationGPS::Ptr gga(double seconds, double latitude, double longitude,
                                    double altitude) {
  auto gps = mrpt::obs::CObservationGPS::Create();
  gps->sensorLabel = "GPS";
  gps->timestamp = time_of(seconds);
  mrpt::obs::gnss::Message_NMEA_GGA message;
  message.fields.fix_quality = 1;
  message.fields.latitude_degrees = latitude;
  message.fields.longitude_degrees = longitude;
  message.fields.altitude_meters = altitude;
  gps->setMsg(message);
  return gps;
}

mrpt::obs::CObservationGPS::Ptr rmc(double seconds, double knots, double course_deg) {
  auto gps = mrpt::obs::CObservationGPS::Create();
  gps->sensorLabel = "GPS";
  gps->timestamp = time_of(seconds);
  mrpt::obs::gnss::Message_NMEA_RMC message;
  message.fields.validity_char = 'A';
  message.fields.speed_knots = knots;
  message.fields.direction_degrees = course_deg;
  gps->setMsg(message);
  return gps;
}

}  // namespace oneac::test
