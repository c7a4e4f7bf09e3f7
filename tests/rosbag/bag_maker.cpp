#include "bag_maker.h"

#include <opencv2/imgcodecs.hpp>

#include <algorithm>

namespace oneac {

namespace fs = std::filesystem;

ros::Time stamp(int frame) {
  return ros::Time(1305031452, 100000000U * static_cast<unsigned>(frame + 1));
}

namespace {

std_msgs::Header header(int frame) {
  std_msgs::Header header;
  header.seq = static_cast<unsigned>(frame);
  header.stamp = stamp(frame);
  header.frame_id = "camera";
  return header;
}

}  // namespace

sensor_msgs::Image image_message(const cv::Mat& pixels, const std::string& encoding, int frame) {
  sensor_msgs::Image message;
  message.header = header(frame);
  message.height = static_cast<unsigned>(pixels.rows);
  message.width = static_cast<unsigned>(pixels.cols);
  message.encoding = encoding;
  message.step = static_cast<unsigned>(pixels.cols * static_cast<int>(pixels.elemSize()));
  const cv::Mat whole = pixels.clone();
  message.data.assign(whole.datastart, whole.dataend);
  return message;
}

sensor_msgs::CompressedImage jpeg_message(const fs::path& file, int frame) {
  sensor_msgs::CompressedImage message;
  message.header = header(frame);
  message.format = "mono8; jpeg compressed ";
  const std::string bytes = read_file(file);
  message.data.assign(bytes.begin(), bytes.end());
  return message;
}

sensor_msgs::CameraInfo info_message(int frame, double right_m) {
  sensor_msgs::CameraInfo info;
  info.header = header(frame);
  info.width = 320;
  info.height = 240;
  info.distortion_model = "plumb_bob";
  info.D.assign(5, 0.0);
  info.K = {250, 0, 159.5, 0, 250, 119.5, 0, 0, 1};
  info.R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  info.P = {250, 0, 159.5, -250 * right_m, 0, 250, 119.5, 0, 0, 0, 1, 0};
  return info;
}

sensor_msgs::Imu imu_message(int frame) {
  sensor_msgs::Imu message;
  message.header = header(frame);
  message.orientation_covariance[0] = -1.0;
  message.linear_acceleration.z = 9.8;
  message.angular_velocity.z = 0.25;
  return message;
}

sensor_msgs::NavSatFix fix_message(int frame) {
  sensor_msgs::NavSatFix message;
  message.header = header(frame);
  message.latitude = 36.72;
  message.longitude = -4.48;
  message.altitude = 12.0;
  return message;
}

nav_msgs::Odometry odometry_message(int frame) {
  nav_msgs::Odometry message;
  message.header = header(frame);
  message.pose.pose.position.x = 0.8 * frame;
  message.pose.pose.orientation.w = 1.0;
  return message;
}

void BagFixture::SetUp() {
  for (const auto& entry : fs::directory_iterator(drive() / "Images")) {
    const bool right = entry.path().filename().string().find("_right") != std::string::npos;
    if (!right) images_.push_back(entry.path());
  }
  std::sort(images_.begin(), images_.end());
  ASSERT_EQ(images_.size(), std::size_t{kFrames});
}

cv::Mat BagFixture::grey(int frame) const {
  return cv::imread(image(frame).string(), cv::IMREAD_GRAYSCALE);
}

void BagFixture::write_drive(rosbag::CompressionType compression, int frames) const {
  rosbag::Bag out(bag().string(), rosbag::bagmode::Write);
  out.setCompression(compression);
  for (int i = 0; i < frames; ++i) {
    out.write("/cam/camera_info", stamp(i), info_message(i));
    out.write("/cam/image_raw", stamp(i), image_message(grey(i), "mono8", i));
  }
}

ProgramResult BagFixture::import(const std::vector<std::string>& extra) const {
  std::vector<std::string> arguments{"import",          "rosbag",          bag().string(), "-o",
                                     rawlog().string(), "--camera-height", "1.5"};
  arguments.insert(arguments.end(), extra.begin(), extra.end());
  return oneac_program(arguments);
}

std::string BagFixture::import_well(const std::vector<std::string>& extra) const {
  const ProgramResult result = import(extra);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return result.err;
}

std::string BagFixture::refusal(const std::vector<std::string>& extra) const {
  const ProgramResult result = import(extra);
  EXPECT_EQ(result.exit_code, 2) << result.out << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  return result.err;
}

}  // namespace oneac
