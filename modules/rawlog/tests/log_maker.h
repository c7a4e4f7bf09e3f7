#pragma once

#include "oneac/base/error.h"

#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationStereoImages.h>
#include <mrpt/serialization/CSerializable.h>

#include <opencv2/core.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace oneac::test {

using Objects = std::vector<mrpt::serialization::CSerializable::Ptr>;
enum class Packing { plain, gzip, zstd };

inline constexpr double kStart = 1.26e9;  // Unix time of the first observation [s]
inline constexpr int kWidth = 64;
inline constexpr int kHeight = 48;

/// The objects as MRPT serialises them, packed.
std::string packed(const Objects& objects, Packing packing = Packing::plain);
/// Any bytes, packed.
std::string packed_bytes(const std::string& plain, Packing packing);
void write_bytes(const std::filesystem::path& file, const std::string& bytes);
void write_log(const std::filesystem::path& file, const Objects& objects,
               Packing packing = Packing::plain);

/// A grey ramp whose level tells images apart; exact through lossless formats.
cv::Mat ramp(int level);
/// f 50, c (32, 24), 64×48, no distortion.
mrpt::img::TCamera calibration();

/// An image observation at kStart + seconds with the given pixels stored in the log.
mrpt::obs::CObservationImage::Ptr stored_image(const std::string& label, double seconds,
                                               const cv::Mat& pixels);
/// The same with the name of an external file.
mrpt::obs::CObservationImage::Ptr external_image(const std::string& label, double seconds,
                                                 const std::string& file);
/// A pair of external images NAME_left.png, NAME_right.png with a baseline of 0.12 m.
mrpt::obs::CObservationStereoImages::Ptr external_pair(const std::string& label, double seconds,
                                                       const std::string& name);
mrpt::obs::CObservationGPS::Ptr gga(double seconds, double latitude, double longitude,
                                    double altitude);
mrpt::obs::CObservationGPS::Ptr rmc(double seconds, double knots, double course_deg);

/// What the InputError thrown by the call says; "" when it throws none.
template <class Call>
std::string input_error(Call&& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace oneac::test
