// A bag that is damaged, or holds what it should not, ends in one line and exit code 2; images
// before the fault are kept.
#include "bag_maker.h"

#include <std_msgs/String.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <random>

namespace oneac {
namespace {

namespace fs = std::filesystem;

class RosbagFaults : public BagFixture {
 protected:
  /// The fourth image is changed.
  void write_with(const std::function<void(sensor_msgs::Image&)>& change) const {
    rosbag::Bag made(bag().string(), rosbag::bagmode::Write);
    for (int i = 0; i < 5; ++i) {
      sensor_msgs::Image message = image_message(grey(i), "mono8", i);
      if (i == 3) change(message);
      made.write("/cam/image_raw", stamp(i), message);
      made.write("/cam/camera_info", stamp(i), info_message(i));
    }
  }
  void write_with(const std::function<void(sensor_msgs::CameraInfo&)>& change) const {
    rosbag::Bag made(bag().string(), rosbag::bagmode::Write);
    for (int i = 0; i < 5; ++i) {
      sensor_msgs::CameraInfo info = info_message(i);
      change(info);
      made.write("/cam/camera_info", stamp(i), info);
      made.write("/cam/image_raw", stamp(i), image_message(grey(i), "mono8", i));
    }
  }
  template <class Message>
  void write_beside(const std::string& topic, const std::function<void(Message&)>& change) const {
    rosbag::Bag made(bag().string(), rosbag::bagmode::Write);
    for (int i = 0; i < 3; ++i) {
      made.write("/cam/camera_info", stamp(i), info_message(i));
      made.write("/cam/image_raw", stamp(i), image_message(grey(i), "mono8", i));
      Message message = made_for(i, Message());
      change(message);
      made.write(topic, stamp(i), message);
    }
  }
  void expect_refused(const std::string& words, const std::vector<std::string>& extra = {}) const {
    const std::string line = refusal(extra);
    EXPECT_NE(line.find(words), std::string::npos) << line;
  }

 private:
  static sensor_msgs::Imu made_for(int frame, const sensor_msgs::Imu&) {
    return imu_message(frame);
  }
  static sensor_msgs::NavSatFix made_for(int frame, const sensor_msgs::NavSatFix&) {
    return fix_message(frame);
  }
  static nav_msgs::Odometry made_for(int frame, const nav_msgs::Odometry&) {
    return odometry_message(frame);
  }
};

TEST_F(RosbagFaults, OfAnImageKeepTheImagesBefore) {
  using Image = sensor_msgs::Image;
  const std::vector<std::pair<std::function<void(Image&)>, std::string>> cases{
      {[](Image& m) { m.data.pop_back(); },
       "its 320x240 pixels of mono8 are 76800 bytes, it holds 76799"},
      {[](Image& m) { m.step = 100; }, "do not fit into rows of 100 bytes"},
      {[](Image& m) { m.height = 0; }, "it says that it has 320x0 pixels"},
      {[](Image& m) { m.width = 4000000000U; }, "it says that it has 4000000000x240 pixels"},
      {[](Image& m) { m.encoding = "16UC1"; }, "its pixels are '16UC1'"},
      {[](Image& m) {
         m.encoding = "yuv422";
         m.width = 159;
       },
       "its rows of yuv422 have 159 pixels, an odd number"},
      {[](Image& m) { m.header.stamp.nsec = 4000000000U; }, "its time is none"},
      {[](Image& m) {
         m.height = 120;
         m.data.resize(m.data.size() / 2);
       },
       "it has 320x120 pixels, the first has 320x240"}};
  for (const auto& [change, words] : cases) {
    write_with(change);
    fs::remove(rawlog());
    expect_refused("bag.rawlog: holds the 3 images before a fault");
    expect_refused("/cam/image_raw: message 4: ");
    expect_refused(words);
    EXPECT_TRUE(fs::exists(rawlog())) << words;
  }
}

TEST_F(RosbagFaults, OfACameraAreNamed) {
  using Info = sensor_msgs::CameraInfo;
  const std::vector<std::pair<std::function<void(Info&)>, std::string>> cases{
      {[](Info& m) { m.K[0] = std::numeric_limits<double>::quiet_NaN(); },
       "/cam/camera_info: message 1: K holds nan"},
      {[](Info& m) { m.K.fill(0.0); }, "its camera is not calibrated (K is 0)"},
      {[](Info& m) { m.K[0] = 1e300; }, "/cam/camera_info: message 1"},
      {[](Info& m) { m.width = 0; }, "it is for images of 0x240 pixels"},
      {[](Info& m) { m.width = 300; }, "is for 300x240, the images are 320x240"},
      {[](Info& m) { m.distortion_model = "omni"; }, "the lens model 'omni' is not supported"},
      {[](Info& m) { m.binning_x = 2; }, "its binning is 2 by 1"}};
  for (const auto& [change, words] : cases) {
    write_with(change);
    expect_refused(words);
    EXPECT_FALSE(fs::exists(rawlog())) << words;
  }
  int count = 0;
  write_with([&count](Info& m) { m.K[2] += ++count; });
  expect_refused("/cam/camera_info: message 2: the calibration changes here");
}

TEST_F(RosbagFaults, OfSensorsAreNamed) {
  const std::vector<std::string> imu{"--imu-topic", "/imu"}, wheels{"--wheels-topic", "/odom"};
  using sensor_msgs::Imu;
  write_beside<Imu>("/imu", [](Imu& m) { m.linear_acceleration_covariance[0] = -1.0; });
  expect_refused("/imu: message 1: it tells no acceleration", imu);
  write_beside<Imu>("/imu", [](Imu& m) { m.angular_velocity.y = std::nan(""); });
  expect_refused("/imu: message 1: angular_velocity holds nan", imu);
  write_beside<Imu>("/imu",
                    [](Imu& m) { std::swap(m.linear_acceleration.y, m.linear_acceleration.z); });
  expect_refused("its Z axis is 90 deg off the vertical", imu);
  write_beside<Imu>("/imu", [](Imu& m) { m.linear_acceleration.z = 1.0; });
  expect_refused("its mean acceleration is 1.00 m/s^2, not that of gravity", imu);
  using nav_msgs::Odometry;
  write_beside<Odometry>("/odom", [](Odometry& m) { m.pose.pose.orientation.w = 0.0; });
  expect_refused("/odom: message 1: its orientation is no rotation", wheels);
  using sensor_msgs::NavSatFix;
  write_beside<NavSatFix>("/fix", [](NavSatFix& m) { m.latitude = 91.0; });
  expect_refused("/fix: message 1: its latitude or longitude");
}

TEST_F(RosbagFaults, OfTheChoiceOfTopicsAreNamed) {
  write_drive();
  expect_refused("it has no topic '/cam/image_row'; did you mean --image-topic /cam/image_raw?",
                 {"--image-topic", "/cam/image_row"});
  expect_refused("/cam/camera_info: its messages are sensor_msgs/CameraInfo",
                 {"--image-topic", "/cam/camera_info"});
  expect_refused("it has no topic '/imu'; leave --imu-topic out", {"--imu-topic", "/imu"});
  expect_refused("are the left images", {"--right-topic", "/cam/image_raw"});
  rosbag::Bag(bag().string(), rosbag::bagmode::Write).write("/text", stamp(0), std_msgs::String());
  expect_refused("no topic of it has images");
}

TEST_F(RosbagFaults, OfADefinitionThatIsNotRossAreNamed) {
  write_drive();
  std::string bytes = read_file(bag());
  const std::string md5 = ros::message_traits::md5sum<sensor_msgs::Image>();
  std::size_t found = 0;
  for (std::size_t at = bytes.find(md5); at != std::string::npos; at = bytes.find(md5, at)) {
    bytes[at] = bytes[at] == 'f' ? 'e' : 'f';
    ++found;
  }
  ASSERT_GT(found, 0U);
  write_text(bag(), bytes);
  expect_refused("/cam/image_raw: its messages are another sensor_msgs/Image than ROS 1's");
}

TEST_F(RosbagFaults, OfAPairAreNamed) {
  const auto write_pair = [&](const std::string& topic, double right_m, int late) {
    rosbag::Bag made(bag().string(), rosbag::bagmode::Write);
    for (int i = 0; i < 3; ++i) {
      made.write("/l/" + topic, stamp(i), image_message(grey(i), "mono8", i));
      made.write("/r/" + topic, stamp(i), image_message(grey(i), "mono8", i + late));
      sensor_msgs::CameraInfo left = info_message(i), right = info_message(i, right_m);
      left.R[1] = right.R[1] = 0.01;
      made.write("/l/camera_info", stamp(i), left);
      made.write("/r/camera_info", stamp(i), right);
    }
  };
  const std::vector<std::string> raw{"--image-topic", "/l/image", "--right-topic", "/r/image"};
  const std::vector<std::string> rect{"--image-topic", "/l/image_rect", "--right-topic",
                                      "/r/image_rect"};
  write_pair("image", 0.54, 0);
  expect_refused("the two cameras' images are not rectified as a pair", raw);
  write_pair("image_rect", -0.54, 0);
  expect_refused("is -0.54 m to the right of the left one", rect);
  write_pair("image_rect", 0.54, 5);
  expect_refused("no image of it has the time of a left one", rect);
  {
    rosbag::Bag made(bag().string(), rosbag::bagmode::Write);
    for (int i = 0; i < 3; ++i) {
      made.write("/l/image_rect", stamp(i), image_message(grey(i), "mono8", i));
      made.write("/r/image_rect", stamp(i), image_message(grey(i), "mono8", i));
      sensor_msgs::CameraInfo right = info_message(i, 0.54);
      right.P[0] = right.P[5] = 300;
      made.write("/l/camera_info", stamp(i), info_message(i));
      made.write("/r/camera_info", stamp(i), right);
    }
  }
  expect_refused("P of its CameraInfo has another f, cx or cy", rect);
}

TEST_F(RosbagFaults, OfATruncatedOrUnfinishedBagAreToldInOneLine) {
  write_drive();
  const std::string whole = read_file(bag());
  write_text(bag(), whole.substr(0, whole.size() / 2));
  expect_refused("is damaged");
  expect_refused("ROS's `rosbag reindex`");
  std::string unfinished = whole;  // as while it is recorded: the place of the index is not known
  const std::size_t place = unfinished.find("index_pos=") + 10;
  std::fill_n(unfinished.begin() + static_cast<std::ptrdiff_t>(place), 8, '\0');
  write_text(bag(), unfinished);
  expect_refused("has no index, as when its recording was cut off");
  write_text(bag(), whole.substr(0, 13));
  expect_refused("is damaged");
  write_text(bag(), "#ROSBAG V1.2\n");
  expect_refused("is a bag of a format before 2.0; bring it to 2.0 with ROS's `rosbag reindex`");
  write_text(bag(), "");
  expect_refused("is empty");
}

TEST_F(RosbagFaults, OfALengthTakeNoMemory) {
  write_drive();
  std::string hurt = read_file(bag());
  const std::size_t length = hurt.find("mono8") - 4 - 12 - std::string("camera").size() - 4 - 8 - 4;
  hurt.replace(length, 4, "\xF0\xFF\xFF\xEF");
  write_text(bag(), hurt);
  const ProgramResult result = import();
  EXPECT_EQ(result.exit_code, 2) << result.out;
  EXPECT_NE(result.err.find("a message of 4026531824 bytes"), std::string::npos) << result.err;
  EXPECT_LT(result.peak_mb, 500U);
}

TEST_F(RosbagFaults, AnywhereInABagNeverEndTheProgram) {
  for (const auto compression : {rosbag::compression::Uncompressed, rosbag::compression::LZ4}) {
    write_drive(compression, 3);
    const std::string whole = read_file(bag());
    for (unsigned seed = 0; seed < 10; ++seed) {
      std::mt19937 random(seed);
      std::string hurt = whole;
      for (int i = 0; i < 8; ++i) {
        // Records' heads are few among pixels: half of the bytes are in the first and last of them.
        const std::size_t span = i % 2 == 0 ? whole.size() : 3000;
        const std::size_t at = random() % span;
        hurt[i % 4 == 3 ? whole.size() - 1 - at : at] = static_cast<char>(random());
      }
      hurt.replace(0, 13, whole, 0, 13);
      write_text(bag(), hurt);
      const ProgramResult result = import();
      EXPECT_TRUE(result.exit_code == 0 || result.exit_code == 2)
          << "seed " << seed << ": " << result.exit_code << ' ' << result.err;
      if (result.exit_code == 2) {
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
      }
    }
  }
}

}  // namespace
}  // namespace oneac
