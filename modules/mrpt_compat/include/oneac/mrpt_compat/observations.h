#pragma once

// Every difference between MRPT versions in observations and images, in one place (rtti.h has that
// of the class factory's macro). Written for 2.5.8; 2.14.7 and 2.15.14 have run, too.
//
// What a port to 3.x needs, by its porting guide; none of it could be tried here:
//  1. CMake: find_package(mrpt_obs) instead of (mrpt-obs), targets mrpt::mrpt_obs instead of
//     mrpt::obs: the top CMakeLists.txt, those of mrpt_compat, rawlog, frontend, initialisers and
//     apps/oneac, cmake/OneacInstall.cmake (names of the exported packages), OneacPlugin.cmake.
//  2. CImage holds no OpenCV matrix: pixels_of() below. Check there the names of depth and stride,
//     and the order of the channels of colour images: OpenCV's is blue first.
//  3. apps/oneac/run/run_gui.cpp: mrpt::opengl's scene objects are mrpt::viz's, in headers
//     mrpt/viz/…, COpenGLScene is Scene. Without mrpt_gui the program builds without --gui.
//  4. CRawlog's entry types are a scoped enum; getSensorPose() and the like return by value, with
//     the old forms deprecated: warnings, and so errors in our presets. Library code uses neither.
//  5. TCLAP and mrpt::vision are gone; oneac uses neither.

#include <mrpt/core/Clock.h>
#include <mrpt/img/CImage.h>
#include <mrpt/img/TCamera.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/serialization/CArchive.h>
#include <mrpt/version.h>

#include <opencv2/core.hpp>

#include <cstdint>
#include <exception>
#include <optional>
#include <string>

// MRPT_VERSION is 0x258 for 2.5.8, and two digits per part (0x020E00) from 2.10.2 on.
#if MRPT_VERSION < 0x1000
#define ONEAC_MRPT_MAJOR (MRPT_VERSION >> 8)
#else
#define ONEAC_MRPT_MAJOR (MRPT_VERSION >> 16)
#endif

namespace oneac::compat {

/// Pixels of an image that is in memory; shares them where this version of MRPT allows it.
inline cv::Mat pixels_of(const mrpt::img::CImage& image) {
#if ONEAC_MRPT_MAJOR < 3
  return image.asCvMat<cv::Mat>(mrpt::img::SHALLOW_COPY);
#else  // CImage holds no OpenCV matrix any more
  const int depth = image.getPixelDepth() == mrpt::img::PixelDepth::D8U ? CV_8U : CV_16U;
  const int type = CV_MAKETYPE(depth, static_cast<int>(image.channels()));
  const cv::Mat borrowed(image.getHeight(), image.getWidth(), type,
                         const_cast<std::uint8_t*>(image.ptrLine<std::uint8_t>(0)),
                         image.getRowStride());
  return borrowed.clone();
#endif
}

/// Unix time [s].
inline double unix_seconds(const mrpt::Clock::time_point& time) {
  return mrpt::Clock::toDouble(time);
}

/// "CObservationImage": the class without its namespace, which older versions leave out.
inline std::string class_name(const mrpt::rtti::CObject& object) {
  const std::string name = object.GetRuntimeClass()->className;
  const auto colon = name.rfind(':');
  return colon == std::string::npos ? name : name.substr(colon + 1);
}

/// The message of this class in a GPS observation, or nullptr. (MRPT's own getMsgByClassPtr() const
/// does not compile in 2.5.8.)
template <class Message>
const Message* gps_message(const mrpt::obs::CObservationGPS& gps) {
  return gps.hasMsgClass<Message>() ? &gps.getMsgByClass<Message>() : nullptr;
}

/// A flag of an observation. MRPT takes it from a log byte by byte; a damaged one is neither true
/// nor false, and must not be looked at as a bool. Only 1 counts.
inline bool is_set(const bool& flag) {
  return reinterpret_cast<const std::uint8_t&>(flag) == 1;
}

/// A field of an IMU's reading, if it has it. (MRPT's own has() trusts the flag.)
inline std::optional<double> imu_field(const mrpt::obs::CObservationIMU& imu,
                                       mrpt::obs::TIMUDataIndex field) {
  if (!is_set(imu.dataIsPresent.at(field))) return std::nullopt;
  return imu.rawMeasurements.at(field);
}

/// What an MRPT exception says, in one line: 2.x wraps the message in a report with a call stack.
inline std::string message_of(const std::exception& error) {
  std::string text = error.what();
  const std::string tag = "Message:";
  if (const auto at = text.find(tag); at != std::string::npos) text.erase(0, at + tag.size());
  text.erase(0, text.find_first_not_of(" \t\r\n"));
  return text.substr(0, text.find_first_of("\r\n"));
}

}  // namespace oneac::compat
