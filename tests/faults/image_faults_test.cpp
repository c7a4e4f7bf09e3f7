#include "fault_fixture.h"

#include "oneac/rawlog/rawlog_source.h"

#include <opencv2/imgcodecs.hpp>

#include <functional>

namespace oneac {
namespace {

namespace fs = std::filesystem;

class ImageFaults : public FaultFixture {
 protected:
  /// A log of six frames of which frame 3 is made by `spoil`.
  void six_frames(const std::function<void(const fs::path&)>& spoil) const {
    test::write_log(log(), textured_frames(6));
    spoil(scratch() / "frame_3.png");
  }
};

TEST_F(ImageFaults, AMissingImageIsLeftOutAndSaid) {
  six_frames([](const fs::path& image) { fs::remove(image); });
  expect_exit(run(), 0, {"1 of 6 images", "frame_3.png"});
  EXPECT_EQ(poses_written(), 5U);
}

TEST_F(ImageFaults, AnEmptyImageEndsTheRunBehindWhatCameBefore) {
  six_frames([](const fs::path& image) { test::write_bytes(image, ""); });
  expect_exit(run(), 2, {"frame_3.png", "empty"});
  EXPECT_EQ(poses_written(), 3U);
}

TEST_F(ImageFaults, ATruncatedImageEndsTheRunBehindWhatCameBefore) {
  six_frames([](const fs::path& image) {
    const std::string whole = file_content(image);
    test::write_bytes(image, whole.substr(0, whole.size() / 3));
  });
  const ProgramResult result = run();
  expect_exit(result, 2, {"frame_3.png"});
  EXPECT_EQ(poses_written(), 3U);
}

TEST_F(ImageFaults, AnImageOfAnotherSizeEndsTheRun) {
  six_frames([](const fs::path& image) {
    cv::imwrite(image.string(), cv::Mat(24, 32, CV_8U, cv::Scalar(90)));
  });
  expect_exit(run(), 2, {"frame_3.png", "32x24", "64x48"});
}

TEST_F(ImageFaults, AnImageThatClaimsGigabytesIsNotBelieved) {
  six_frames([](const fs::path& image) {
    std::string bytes = file_content(image);
    bytes[17] = bytes[21] = '\x7f';  // the second byte of the width and of the height
    test::write_bytes(image, bytes);
  });
  expect_exit(run(), 2, {"frame_3.png", "absurd size"});
}

TEST_F(ImageFaults, SixteenBitColourAndGreyImagesMayBeMixed) {
  six_frames([](const fs::path& image) {
    cv::Mat wide;
    textured(3).convertTo(wide, CV_16U, 256.0);
    cv::imwrite(image.string(), wide);
  });
  cv::Mat colour;
  const cv::Mat grey = textured(4);
  cv::merge(std::vector<cv::Mat>{grey, grey, grey}, colour);
  cv::imwrite((scratch() / "frame_4.png").string(), colour);
  expect_exit(run(), 0, {});
  EXPECT_EQ(poses_written(), 6U);
}

TEST_F(ImageFaults, ACmykJpegIsReadAsGrey) {
  const fs::path copy = scratch() / "cmyk.jpg";
  fs::copy_file(fs::path(ONEAC_FAULT_DATA) / "cmyk.jpg", copy);
  test::write_log(log(), {test::external_image("CAM", 0, "cmyk.jpg"),
                          test::external_image("CAM", 0.1, "cmyk.jpg")});
  expect_exit(run(), 0, {});
  RawlogSource source({log(), {}, "", "", "auto", {}, 0, 0, 1, false, 0.0, {}});
  const CameraFrame frame = source.load(source.next().value());
  const ImageView view = frame.image.view();
  EXPECT_LT(view.data[view.stride * 20 + 4], 60);  // black ink fades out from left to right
  EXPECT_GT(view.data[view.stride * 20 + 60], 200);
}

TEST_F(ImageFaults, BlackAndSaturatedImagesGiveFinitePosesThatAreNotMetric) {
  for (const int level : {0, 255}) {
    test::Objects objects;
    for (int i = 0; i < 5; ++i) {
      cv::Mat flat(test::kHeight, test::kWidth, CV_8U, cv::Scalar(level));
      flat.at<std::uint8_t>(0, i) ^= 1U;  // or they would repeat each other
      objects.push_back(test::stored_image("CAM", 0.1 * i, flat));
    }
    test::write_log(log(), objects);
    expect_exit(run(), 0, {});
    EXPECT_EQ(poses_written(), 5U) << "level " << level;
  }
}

TEST_F(ImageFaults, ImagesOfAFewPixelsGiveFinitePoses) {
  test::write_bytes(scratch() / "calib.txt", "P0: 50 0 32 0 0 50 24 0 0 0 1 0\n");
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(2, 3), cv::Size(15, 9), cv::Size(400, 1)}) {
    SCOPED_TRACE(std::to_string(size.width) + "x" + std::to_string(size.height));
    test::Objects objects;
    for (int i = 0; i < 3; ++i) {
      objects.push_back(test::stored_image("CAM", 0.1 * i, cv::Mat(size, CV_8U, cv::Scalar(i))));
    }
    test::write_log(log(), objects);
    expect_exit(run({"--calibration", (scratch() / "calib.txt").string()}), 0, {});
    EXPECT_EQ(poses_written(), 3U);
  }
}

TEST_F(ImageFaults, AnImageThatVanishesDuringTheRunIsNamed) {
  test::write_log(log(), textured_frames(3));
  RawlogSource source({log(), {}, "", "", "auto", {}, 0, 0, 1, false, 0.0, {}});
  const auto ticket = source.next();
  fs::rename(scratch() / "frame_0.png", scratch() / "elsewhere.png");
  const std::string fault = test::input_error([&] { static_cast<void>(source.load(*ticket)); });
  EXPECT_NE(fault.find("frame_0.png: the image cannot be opened"), std::string::npos) << fault;
  fs::remove(scratch() / "frame_1.png");
  EXPECT_EQ(source.next()->name, "frame_2.png");
  EXPECT_EQ(source.report().images_missing, 1U);
}

TEST_F(ImageFaults, ALogThatIsMovedDuringTheRunIsReadOn) {
  test::write_log(log(), textured_frames(3));
  RawlogSource source({log(), {}, "", "", "auto", {}, 0, 0, 1, false, 0.0, {}});
  fs::rename(log(), scratch() / "elsewhere.rawlog");
  std::size_t frames = 0;
  while (source.next()) ++frames;
  EXPECT_EQ(frames, 3U);
  EXPECT_EQ(source.report().damage, "");
}

TEST_F(ImageFaults, ADamagedJpegInTheLogDoesNotEndTheProgram) {
  cv::Mat colour(test::kHeight, test::kWidth, CV_8UC3, cv::Scalar(20, 90, 160));
  test::Objects objects;
  for (int i = 0; i < 3; ++i) objects.push_back(test::stored_image("CAM", 0.1 * i, colour));
  mrpt::img::CImage::DISABLE_JPEG_COMPRESSION(false);
  std::string bytes = test::packed(objects);
  const std::size_t second = bytes.find("\xff\xd8\xff", bytes.find("\xff\xd8\xff") + 1);
  ASSERT_NE(second, std::string::npos);
  bytes[second + 1] = '\0';
  test::write_bytes(log(), bytes);
  expect_exit(run(), 2, {"record 1", "cannot be decoded"});
  EXPECT_EQ(poses_written(), 1U);
}

}  // namespace
}  // namespace oneac
