// What a bag of ROS 1 holds becomes a log that gives the poses of the same images in a folder.
#include "bag_maker.h"

#include "oneac/evaluation/trajectory_io.h"

#include <opencv2/imgcodecs.hpp>

#include <functional>
#include <map>

namespace oneac {
namespace {

namespace fs = std::filesystem;

class Rosbag : public BagFixture {
 protected:
  using Poses = std::vector<Eigen::Isometry3d>;

  [[nodiscard]] Poses poses_of(const fs::path& log) const {
    const ProgramResult result = oneac_program({"run", log.string(), "-o", out()});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return read_kitti(fs::path(out()) / "trajectory_camera.kitti").poses;
  }
  /// Of the same images in KITTI's layout.
  [[nodiscard]] Poses expected() const {
    std::string times;
    fs::create_directories(scratch() / "kitti" / "image_0");
    for (int i = 0; i < kFrames; ++i) {
      fs::copy_file(image(i), scratch() / "kitti" / "image_0" / (std::to_string(i) + ".jpg"));
      times += "1305031452." + std::to_string(i + 1) + "\n";
    }
    write_text(scratch() / "kitti" / "times.txt", times);
    write_text(scratch() / "kitti" / "calib.txt", "P0: 250 0 159.5 0 0 250 119.5 0 0 0 1 0\n");
    const fs::path log = scratch() / "kitti.rawlog";
    const ProgramResult made = oneac_program({"import", "kitti", (scratch() / "kitti").string(),
                                              "-o", log.string(), "--camera-height", "1.5"});
    EXPECT_EQ(made.exit_code, 0) << made.err;
    return poses_of(log);
  }
  void expect_same(const Poses& some, const Poses& others, const std::string& what) const {
    ASSERT_EQ(some.size(), others.size()) << what;
    for (std::size_t i = 0; i < some.size(); ++i) {
      EXPECT_TRUE(some[i].isApprox(others[i], 1e-6)) << what << ": frame " << i;
    }
  }
  [[nodiscard]] std::string info() const {
    const ProgramResult result = oneac_program({"info", rawlog().string()});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.out;
  }
  /// Three images, a camera told by `change`, in a bag.
  void write_camera(const std::function<void(sensor_msgs::CameraInfo&)>& change,
                    const std::string& topic = "/cam/image_raw") const {
    rosbag::Bag made(bag().string(), rosbag::bagmode::Write);
    for (int i = 0; i < 3; ++i) {
      sensor_msgs::CameraInfo camera = info_message(i);
      change(camera);
      made.write(topic, stamp(i), image_message(grey(i), "mono8", i));
      made.write("/cam/camera_info", stamp(i), camera);
    }
  }
};

TEST_F(Rosbag, GivesThePosesOfTheSameImagesInAFolder) {
  const Poses kitti = expected();
  const std::map<std::string, rosbag::CompressionType> kinds{
      {"none", rosbag::compression::Uncompressed},
      {"bz2", rosbag::compression::BZ2},
      {"lz4", rosbag::compression::LZ4}};
  for (const auto& [name, compression] : kinds) {
    write_drive(compression);
    import_well();
    expect_same(poses_of(rawlog()), kitti, name);
  }
}

TEST_F(Rosbag, OfJpegsKeepsTheirFiles) {
  {
    rosbag::Bag made(bag().string(), rosbag::bagmode::Write);
    for (int i = 0; i < kFrames; ++i) {
      made.write("/cam/image_raw/compressed", stamp(i), jpeg_message(image(i), i));
      made.write("/cam/camera_info", stamp(i), info_message(i));
    }
  }
  import_well();
  EXPECT_EQ(read_file(imported("000001.jpg")), read_file(image(0)));
  expect_same(poses_of(rawlog()), expected(), "jpeg");
}

TEST_F(Rosbag, KeepsThePixelsOfEachEncoding) {
  const cv::Mat one(48, 64, CV_8UC1, cv::Scalar(77)), deep(48, 64, CV_16UC1, cv::Scalar(0x1234));
  const cv::Mat bgr(48, 64, CV_8UC3, cv::Scalar(10, 100, 200));
  const cv::Mat rgb(48, 64, CV_8UC3, cv::Scalar(200, 100, 10));
  const cv::Mat bgra(48, 64, CV_8UC4, cv::Scalar(10, 100, 200, 50));
  const cv::Mat rgba(48, 64, CV_8UC4, cv::Scalar(200, 100, 10, 50));
  const cv::Mat deep_bgr(48, 64, CV_16UC3, cv::Scalar(1000, 10000, 60000));
  const cv::Mat deep_rgb(48, 64, CV_16UC3, cv::Scalar(60000, 10000, 1000));
  const cv::Mat deep_bgra(48, 64, CV_16UC4, cv::Scalar(1000, 10000, 60000, 5));
  const cv::Mat deep_rgba(48, 64, CV_16UC4, cv::Scalar(60000, 10000, 1000, 5));
  const std::map<std::string, std::pair<cv::Mat, cv::Mat>> cases{{"mono8", {one, one}},
                                                                 {"mono16", {deep, deep}},
                                                                 {"bgr8", {bgr, bgr}},
                                                                 {"rgb8", {rgb, bgr}},
                                                                 {"bgra8", {bgra, bgr}},
                                                                 {"rgba8", {rgba, bgr}},
                                                                 {"8UC1", {one, one}},
                                                                 {"8UC3", {bgr, bgr}},
                                                                 {"bgr16", {deep_bgr, deep_bgr}},
                                                                 {"rgb16", {deep_rgb, deep_bgr}},
                                                                 {"bgra16", {deep_bgra, deep_bgr}},
                                                                 {"rgba16", {deep_rgba, deep_bgr}}};
  for (const auto& [encoding, images] : cases) {
    {
      rosbag::Bag made(bag().string(), rosbag::bagmode::Write);
      for (int i = 0; i < 2; ++i) {
        made.write("/image", stamp(i), image_message(images.first, encoding, i));
        made.write("/camera_info", stamp(i), info_message(i));
      }
    }
    write_text(scratch() / "cameras.txt", "1 PINHOLE 64 48 50 50 32 24\n");
    import_well({"--calibration", (scratch() / "cameras.txt").string()});
    const cv::Mat got = cv::imread(imported("000002.png").string(), cv::IMREAD_UNCHANGED);
    ASSERT_EQ(got.type(), images.second.type()) << encoding;
    EXPECT_EQ(cv::norm(got, images.second, cv::NORM_INF), 0.0) << encoding;
  }
}

TEST_F(Rosbag, ReadsThePixelsOfABigEndianMachine) {
  const std::map<std::string, std::pair<cv::Mat, cv::Scalar>> cases{
      {"mono16", {cv::Mat(48, 64, CV_16UC1, cv::Scalar(0x1234)), {0x3412}}},
      {"rgb16",
       {cv::Mat(48, 64, CV_16UC3, cv::Scalar(0x1234, 0x0100, 0x0002)), {0x0200, 0x0001, 0x3412}}}};
  write_text(scratch() / "cameras.txt", "1 PINHOLE 64 48 50 50 32 24\n");
  for (const auto& [encoding, images] : cases) {
    {
      rosbag::Bag made(bag().string(), rosbag::bagmode::Write);
      for (int i = 0; i < 2; ++i) {
        sensor_msgs::Image message = image_message(images.first, encoding, i);
        message.is_bigendian = 1;
        made.write("/image", stamp(i), message);
      }
    }
    import_well({"--calibration", (scratch() / "cameras.txt").string()});
    const cv::Mat got = cv::imread(imported("000001.png").string(), cv::IMREAD_UNCHANGED);
    const cv::Mat expected(got.rows, got.cols, images.first.type(), images.second);
    ASSERT_EQ(got.type(), expected.type()) << encoding;
    EXPECT_EQ(cv::norm(got, expected, cv::NORM_INF), 0.0) << encoding;
  }
}

/// A surface of one colour, seen through the filters of a sensor whose levels are `step` apart.
template <class Level>
cv::Mat mosaic(const std::string& pattern, int step) {
  const std::map<char, int> level{{'b', 10}, {'g', 100}, {'r', 200}};
  cv::Mat pixels(48, 64, cv::DataType<Level>::type);
  for (int y = 0; y < pixels.rows; ++y) {
    for (int x = 0; x < pixels.cols; ++x) {
      const auto filter = static_cast<std::size_t>(2 * (y % 2) + x % 2);
      pixels.at<Level>(y, x) = static_cast<Level>(step * level.at(pattern[filter]));
    }
  }
  return pixels;
}

TEST_F(Rosbag, TakesTheColoursOfEachBayerPattern) {
  write_text(scratch() / "cameras.txt", "1 PINHOLE 64 48 50 50 32 24\n");
  for (const std::string pattern : {"rggb", "bggr", "gbrg", "grbg"}) {
    for (const int step : {1, 16}) {  // 8 bits, and 12 of 16
      const std::string encoding = "bayer_" + pattern + (step == 1 ? "8" : "16");
      const cv::Mat pixels =
          step == 1 ? mosaic<std::uint8_t>(pattern, step) : mosaic<std::uint16_t>(pattern, step);
      {
        rosbag::Bag made(bag().string(), rosbag::bagmode::Write);
        for (int i = 0; i < 2; ++i) {
          made.write("/image", stamp(i), image_message(pixels, encoding, i));
        }
      }
      import_well({"--calibration", (scratch() / "cameras.txt").string()});
      cv::Mat got = cv::imread(imported("000001.png").string(), cv::IMREAD_UNCHANGED);
      ASSERT_EQ(got.type(), CV_MAKETYPE(pixels.depth(), 3)) << encoding;
      got.convertTo(got, CV_8U, 1.0 / step);
      EXPECT_EQ(got.at<cv::Vec3b>(20, 20), cv::Vec3b(10, 100, 200)) << encoding;
      EXPECT_EQ(got.at<cv::Vec3b>(21, 21), cv::Vec3b(10, 100, 200)) << encoding;
    }
  }
}

/// Two bytes a pixel: Y of each, U and V of two pixels, from what BT.601 makes of a colour.
cv::Mat yuv422(bool y_first) {
  constexpr std::uint8_t kU = 90, kV = 190;
  cv::Mat pixels(48, 64, CV_8UC2);
  for (int y = 0; y < pixels.rows; ++y) {
    for (int x = 0; x < pixels.cols; ++x) {
      const auto level = static_cast<std::uint8_t>(60 + 2 * x);
      const std::uint8_t colour = x % 2 == 0 ? kU : kV;
      pixels.at<cv::Vec2b>(y, x) = y_first ? cv::Vec2b(level, colour) : cv::Vec2b(colour, level);
    }
  }
  return pixels;
}

TEST_F(Rosbag, TakesTheColoursOfYuv422InEitherOrder) {
  write_text(scratch() / "cameras.txt", "1 PINHOLE 64 48 50 50 32 24\n");
  for (const auto& [encoding, y_first] : std::map<std::string, bool>{
           {"yuv422", false}, {"uyvy", false}, {"yuv422_yuy2", true}, {"yuyv", true}}) {
    {
      rosbag::Bag made(bag().string(), rosbag::bagmode::Write);
      for (int i = 0; i < 2; ++i) {
        made.write("/image", stamp(i), image_message(yuv422(y_first), encoding, i));
      }
    }
    import_well({"--calibration", (scratch() / "cameras.txt").string()});
    const cv::Mat got = cv::imread(imported("000001.png").string());
    const auto pixel = got.at<cv::Vec3b>(20, 20);  // Y = 100, U = 90, V = 190
    constexpr double kLuma = 1.164 * (100 - 16);
    EXPECT_NEAR(pixel[0], kLuma + 2.018 * (90 - 128), 1.0) << encoding;
    EXPECT_NEAR(pixel[1], kLuma - 0.391 * (90 - 128) - 0.813 * (190 - 128), 1.0) << encoding;
    EXPECT_NEAR(pixel[2], kLuma + 1.596 * (190 - 128), 1.0) << encoding;
  }
}

TEST_F(Rosbag, OfARectifiedPairGivesThePosesOfItsLeftImages) {
  {
    rosbag::Bag made(bag().string(), rosbag::bagmode::Write);
    for (int i = 0; i < kFrames; ++i) {
      for (const auto& [side, place] :
           std::map<std::string, double>{{"left", 0.0}, {"right", 0.54}}) {
        made.write("/" + side + "/image_rect", stamp(i), image_message(grey(i), "mono8", i));
        made.write("/" + side + "/camera_info", stamp(i), info_message(i, place));
      }
    }
  }
  const std::string notes =
      import_well({"--image-topic", "/left/image_rect", "--right-topic", "/right/image_rect"});
  EXPECT_NE(notes.find("8 right images of 8, 0.540 m beside the left ones"), std::string::npos)
      << notes;
  EXPECT_NE(info().find("left_image_rect/right: 8 of 8 present"), std::string::npos) << info();
  expect_same(poses_of(rawlog()), expected(), "pair");
}

TEST_F(Rosbag, TakesTheLensOfCameraInfo) {
  const std::map<std::string, std::vector<double>> lenses{
      {"plumb_bob", {-0.05, 0.01, 0.001, -0.001, 0.002}},
      {"rational_polynomial", {-0.05, 0.01, 0.001, -0.001, 0.002, 0.003, 0.004, 0.005}},
      {"equidistant", {0.01, -0.02, 0.003, -0.004}}};
  for (const auto& [model, D] : lenses) {
    write_camera([&, name = model, terms = D](sensor_msgs::CameraInfo& camera) {
      camera.distortion_model = name;
      camera.D = terms;
    });
    import_well();
    const std::string told = info();
    std::string yaml =
        "image_width: 320\nimage_height: 240\ncamera_name: c\ncamera_matrix:\n  rows: 3\n"
        "  cols: 3\n  data: [250, 0, 159.5, 0, 250, 119.5, 0, 0, 1]\ndistortion_model: " +
        model + "\ndistortion_coefficients:\n  rows: 1\n  cols: " + std::to_string(D.size()) +
        "\n  data: [";
    for (const double term : D) yaml += (yaml.back() == '[' ? "" : ", ") + std::to_string(term);
    write_text(scratch() / "ros.yaml", yaml + "]\n");
    import_well({"--calibration", (scratch() / "ros.yaml").string()});
    EXPECT_EQ(info(), told) << model;
  }
}

TEST_F(Rosbag, TakesPOfImagesThatSayTheyAreRectified) {
  write_camera(
      [](sensor_msgs::CameraInfo& camera) {
        camera.D[0] = -0.3;
        camera.K[0] = camera.K[4] = 240;
      },
      "/cam/image_rect_color");
  const std::string notes = import_well();
  EXPECT_NE(notes.find("the calibration is P of /cam/camera_info"), std::string::npos) << notes;
  EXPECT_NE(info().find("250"), std::string::npos) << info();
  EXPECT_EQ(info().find("240, fy"), std::string::npos) << info();
}

TEST_F(Rosbag, TakesThePartOfTheSensorThatTheImagesShow) {
  write_camera([](sensor_msgs::CameraInfo& camera) {
    camera.width = 1000;
    camera.height = 800;
    camera.K = {500, 0, 419, 0, 500, 339, 0, 0, 1};
    camera.roi.x_offset = 100;
    camera.roi.y_offset = 100;
    camera.roi.width = 640;
    camera.roi.height = 480;
    camera.binning_x = camera.binning_y = 2;
  });
  import_well();
  const std::string binned = info();
  write_camera([](sensor_msgs::CameraInfo&) {});
  import_well();
  EXPECT_EQ(binned.find("159.25") != std::string::npos, true) << binned;  // (319 + 0.5) / 2 - 0.5
}

TEST_F(Rosbag, WritesGpsImuAndWheels) {
  {
    rosbag::Bag made(bag().string(), rosbag::bagmode::Write);
    for (int i = 0; i < kFrames; ++i) {
      made.write("/cam/camera_info", stamp(i), info_message(i));
      made.write("/cam/image_raw", stamp(i), image_message(grey(i), "mono8", i));
      made.write("/imu", stamp(i), imu_message(i));
      made.write("/wheels", stamp(i), odometry_message(i));
      sensor_msgs::NavSatFix fix = fix_message(i);
      if (i < 2) fix.status.status = sensor_msgs::NavSatStatus::STATUS_NO_FIX;
      made.write("/fix", stamp(i), fix);
    }
  }
  const ProgramResult alone = import();
  EXPECT_NE(alone.out.find("6 GPS epochs, 0 IMU samples\n"), std::string::npos) << alone.out;
  EXPECT_NE(alone.err.find("/imu (sensor_msgs/Imu, 8) left out: give --imu-topic"),
            std::string::npos)
      << alone.err;
  const ProgramResult all = import({"--imu-topic", "/imu", "--wheels-topic", "/wheels"});
  EXPECT_NE(all.out.find("6 GPS epochs, 8 IMU samples, 8 odometer readings\n"), std::string::npos)
      << all.out << all.err;
  const std::string told = info();
  for (const char* kind : {"CObservationIMU", "CObservationOdometry", "CObservationGPS"}) {
    EXPECT_NE(told.find(kind), std::string::npos) << told;
  }
}

TEST_F(Rosbag, TakesTheTimeOfRecordingWhereHeadersHaveNone) {
  {
    rosbag::Bag made(bag().string(), rosbag::bagmode::Write);
    for (int i = 0; i < kFrames; ++i) {
      sensor_msgs::Image message = image_message(grey(i), "mono8", i);
      message.header.stamp = ros::Time(0, 0);
      made.write("/cam/image_raw", stamp(i), message);
      made.write("/cam/camera_info", stamp(i), info_message(i));
    }
  }
  const std::string notes = import_well();
  EXPECT_NE(notes.find("8 messages of /cam/image_raw have no time"), std::string::npos) << notes;
  expect_same(poses_of(rawlog()), expected(), "times of recording");
}

TEST_F(Rosbag, ListsItsTopicsWhereItsImagesHaveToBeChosen) {
  {
    rosbag::Bag made(bag().string(), rosbag::bagmode::Write);
    for (int i = 0; i < kFrames; ++i) {
      made.write("/left/image_raw", stamp(i), image_message(grey(i), "mono8", i));
      made.write("/right/image_raw/compressed", stamp(i), jpeg_message(image(i), i));
      made.write("/left/camera_info", stamp(i), info_message(i));
    }
  }
  const ProgramResult listed = import();
  EXPECT_EQ(listed.exit_code, 2);
  EXPECT_EQ(listed.out,
            "/left/camera_info            sensor_msgs/CameraInfo       8\n"
            "/left/image_raw              sensor_msgs/Image            8\n"
            "/right/image_raw/compressed  sensor_msgs/CompressedImage  8\n");
  EXPECT_NE(listed.err.find("2 topics have images"), std::string::npos) << listed.err;
  EXPECT_NE(listed.err.find("choose with --image-topic"), std::string::npos) << listed.err;
  import_well({"--image-topic", "/left/image_raw"});
}

TEST_F(Rosbag, LeavesOutAnImageWhoseStampJumps) {
  for (const int jump_s : {100000, -100}) {
    {
      rosbag::Bag made(bag().string(), rosbag::bagmode::Write);
      for (int i = 0; i < kFrames; ++i) {
        sensor_msgs::Image message = image_message(grey(i), "mono8", i);
        if (i == 4) message.header.stamp += ros::Duration(jump_s, 0);
        made.write("/cam/image_raw", stamp(i), message);
        made.write("/cam/camera_info", stamp(i), info_message(i));
      }
    }
    const std::string notes = import_well();
    const std::string off = jump_s > 0 ? "100000 s after" : "100 s before";
    EXPECT_NE(notes.find("1 image of /cam/image_raw is " + off +
                         " its neighbours (message 5), and left out"),
              std::string::npos)
        << notes;
    EXPECT_NE(info().find("7 present"), std::string::npos) << info();
  }
}

TEST_F(Rosbag, SortsImagesThatCameInAnotherOrder) {
  {
    rosbag::Bag made(bag().string(), rosbag::bagmode::Write);
    for (int i = 0; i < kFrames; ++i) {
      const int other = i ^ 1;  // by twos
      made.write("/cam/image_raw", stamp(i), image_message(grey(other), "mono8", other));
      made.write("/cam/camera_info", stamp(i), info_message(i));
    }
  }
  EXPECT_EQ(import_well().find("left out"), std::string::npos);
  expect_same(poses_of(rawlog()), expected(), "another order");
}

TEST_F(Rosbag, TakesItsRateFromTheFlag) {
  write_drive();
  import_well({"--fps", "20"});
  EXPECT_NE(info().find("0.35"), std::string::npos) << info();
}

}  // namespace
}  // namespace oneac
