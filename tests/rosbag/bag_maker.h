#pragma once

#include "drive_fixture.h"

#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/NavSatFix.h>

#include <opencv2/core.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace oneac {

/// Of frame i of the drive: ten a second.
[[nodiscard]] ros::Time stamp(int frame);

// Messages as drivers fill them.
[[nodiscard]] sensor_msgs::Image image_message(const cv::Mat& pixels, const std::string& encoding,
                                               int frame);
[[nodiscard]] sensor_msgs::CompressedImage jpeg_message(const std::filesystem::path& file,
                                                        int frame);
/// The camera of the drive, and its place to the right of the left one.
[[nodiscard]] sensor_msgs::CameraInfo info_message(int frame, double right_m = 0.0);
/// Of a car that stands.
[[nodiscard]] sensor_msgs::Imu imu_message(int frame);
[[nodiscard]] sensor_msgs::NavSatFix fix_message(int frame);
[[nodiscard]] nav_msgs::Odometry odometry_message(int frame);

/// Images of a short drive, and bags and logs in a folder of the test's own.
class BagFixture : public DriveFixture {
 protected:
  void SetUp() override;

  [[nodiscard]] std::filesystem::path bag() const { return scratch() / "drive.bag"; }
  [[nodiscard]] std::filesystem::path rawlog() const { return scratch() / "bag.rawlog"; }
  /// What was written to <log base>_Images.
  [[nodiscard]] std::filesystem::path imported(const std::string& name) const {
    return scratch() / "bag_Images" / name;
  }
  [[nodiscard]] cv::Mat grey(int frame) const;
  [[nodiscard]] const std::filesystem::path& image(int frame) const {
    return images_[static_cast<std::size_t>(frame)];
  }
  /// /cam/image_raw (mono8) and /cam/camera_info.
  void write_drive(rosbag::CompressionType compression = rosbag::compression::Uncompressed,
                   int frames = kFrames) const;

  [[nodiscard]] ProgramResult import(const std::vector<std::string>& extra = {}) const;
  /// @return stderr
  std::string import_well(const std::vector<std::string>& extra = {}) const;
  /// The one line that a bag is refused with.
  [[nodiscard]] std::string refusal(const std::vector<std::string>& extra = {}) const;

 private:
  std::vector<std::filesystem::path> images_;
};

}  // namespace oneac
