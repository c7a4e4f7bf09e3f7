#pragma once

#include "oneac/rawlog/sensor_records.h"

#include <cstddef>
#include <filesystem>
#include <memory>

namespace oneac {

/// Writes a rawlog in MRPT's observation format, gzip-compressed, images in files of their own.
///
/// The log appears under its name when close() is called, whole, or not at all: until then it grows
/// in a temporary file beside it. Records are stored in the order of the calls; give them in time.
class RawlogWriter {
 public:
  /// @throws InputError when the folder of the log cannot be made or written to
  explicit RawlogWriter(const std::filesystem::path& log);
  /// Without close(): removes the temporary file.
  ~RawlogWriter();
  RawlogWriter(RawlogWriter&&) noexcept;
  RawlogWriter& operator=(RawlogWriter&&) noexcept;

  // Each throws OutputError when the record cannot be written.
  void write(const ImageRecord& record);   ///< a CObservationImage
  void write(const StereoRecord& record);  ///< a CObservationStereoImages
  /// A CObservationGPS with a GGA message and, when the velocity is known, another one with an RMC
  /// message under the same label and time, as the receiver of the Málaga dataset does.
  void write(const GpsRecord& record);
  void write(const ImuRecord& record);       ///< a CObservationIMU
  void write(const OdometryRecord& record);  ///< a CObservationOdometry, without speeds

  /// Puts the log in place. @throws OutputError naming it
  void close();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace oneac
