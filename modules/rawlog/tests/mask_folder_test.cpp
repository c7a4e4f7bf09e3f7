#include "images/mask_folder.h"

#include "log_maker.h"

#include "oneac/rawlog/rawlog_source.h"
#include "oneac/test_support/temporary_folder.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include <string>

namespace oneac {
namespace {

namespace fs = std::filesystem;

class Masks : public ::testing::Test {
 protected:
  Masks() { fs::create_directories(masks()); }
  [[nodiscard]] fs::path masks() const { return folder_.path() / "masks"; }
  void add(const std::string& name, int width = test::kWidth, int height = test::kHeight) const {
    cv::Mat mask(height, width, CV_8UC1, cv::Scalar(255));
    mask.rowRange(height / 2, height) = 0;
    cv::imwrite((masks() / name).string(), mask);
  }
  [[nodiscard]] std::string found(const std::string& image, std::size_t index = 0) const {
    return MaskFolder(masks()).mask_of(image, index).filename().string();
  }
  [[nodiscard]] std::string fault_of(const std::string& image, std::size_t index = 0) const {
    return test::input_error([&] { static_cast<void>(found(image, index)); });
  }
  TemporaryFolder folder_;
};

TEST_F(Masks, AreCalledAsTheirImages) {
  for (const char* name : {"a.png", "b.jpg.png", "c_mask.png", "mask_d.jpg", "7.png"}) add(name);
  add("img_1261229980.100000_left.png");
  add("._a.png");
  EXPECT_EQ(found("a.jpg"), "a.png");
  EXPECT_EQ(found("b.jpg"), "b.jpg.png");
  EXPECT_EQ(found("c.jpg"), "c_mask.png");
  EXPECT_EQ(found("d.jpg"), "mask_d.jpg");
  EXPECT_EQ(found("000007.jpg"), "7.png");
  EXPECT_EQ(found("img_1261229980.100000_left.jpg"), "img_1261229980.100000_left.png");
  EXPECT_EQ(found("", 7), "7.png") << "of an image in the log";
}

TEST_F(Masks, SayWhichIsMissingOrThereTwice) {
  EXPECT_NE(fault_of("a.jpg").find("holds no pictures"), std::string::npos);
  add("a.png");
  EXPECT_NE(fault_of("000012.jpg").find("no mask for image 000012.jpg; add 000012.png"),
            std::string::npos)
      << fault_of("000012.jpg");
  EXPECT_NE(fault_of("", 3).find("no mask for image 3; add 3.png"), std::string::npos);
  add("a_mask.png");
  EXPECT_NE(fault_of("a.jpg").find("a.png and a_mask.png are masks of one image"),
            std::string::npos)
      << fault_of("a.jpg");
  const std::string none = test::input_error([&] { MaskFolder(folder_.path() / "none"); });
  EXPECT_NE(none.find("none: no such folder of masks"), std::string::npos) << none;
}

TEST_F(Masks, OfRightImagesAreThoseOfTheirNamesOrOfAFolderOfTheirOwn) {
  add("a_left.png");
  add("a_right.png");
  add("000003.png");
  const MaskFolder beside(masks());
  EXPECT_EQ(beside.mask_of_right("a_right.jpg", "a_left.jpg", 0).filename(), "a_right.png");
  EXPECT_EQ(beside.mask_of_right("b_right.jpg", "b_left.jpg", 1), "");
  EXPECT_EQ(beside.mask_of_right("000003.png", "000003.png", 3), "");  // that is the left one's
  EXPECT_EQ(beside.mask_of_right("", "", 3), "");
  fs::create_directories(masks() / "right");
  add("right/000003.png");
  const MaskFolder apart(masks());
  EXPECT_EQ(apart.mask_of_right("000003.png", "000003.png", 3), masks() / "right" / "000003.png");
  EXPECT_EQ(apart.mask_of_right("", "", 3), masks() / "right" / "000003.png");
  const std::string missing = test::input_error(
      [&] { static_cast<void>(apart.mask_of_right("000004.png", "000004.png", 4)); });
  EXPECT_NE(missing.find("no mask for image 000004.png"), std::string::npos) << missing;
}

TEST_F(Masks, OfPairsGoWithBothImagesThroughTheSource) {
  const std::string base = (folder_.path() / "a").string();
  cv::imwrite(base + "_left.png", test::ramp(10));
  cv::imwrite(base + "_right.png", test::ramp(20));
  SourceOptions options;
  options.log = folder_.path() / "drive.rawlog";
  options.mask_dir = masks();
  options.stereo = true;
  test::write_log(options.log, {test::external_pair("PAIR", 0.0, base)});
  add("a_left.png");
  RawlogSource one(options);
  const CameraFrame lone = one.load(*one.next());
  EXPECT_FALSE(lone.mask.empty());
  EXPECT_FALSE(lone.right.empty());
  EXPECT_TRUE(lone.right_mask.empty());
  add("a_right.png");
  RawlogSource both(options);
  const CameraFrame frame = both.load(*both.next());
  ASSERT_EQ(frame.right_mask.width(), frame.right.width());
  EXPECT_EQ(frame.right_mask.row(test::kHeight / 2)[5], 0);
}

TEST_F(Masks, GoWithTheirImagesThroughTheSource) {
  SourceOptions options;
  options.log = folder_.path() / "drive.rawlog";
  options.mask_dir = masks();
  test::write_log(options.log, {test::stored_image("CAM", 0.0, test::ramp(0)),
                                test::stored_image("CAM", 0.1, test::ramp(1))});
  add("0.png");
  RawlogSource source(options);
  const CameraFrame frame = source.load(*source.next());
  ASSERT_EQ(frame.mask.width(), frame.image.width());
  EXPECT_EQ(frame.mask.row(test::kHeight / 2 - 1)[5], 255);
  EXPECT_EQ(frame.mask.row(test::kHeight / 2)[5], 0);
  const std::string missing = test::input_error([&] { static_cast<void>(source.next()); });
  EXPECT_NE(missing.find("no mask for image 1"), std::string::npos) << missing;
  add("1.png", 20, 10);
  RawlogSource again(options);
  static_cast<void>(again.next());
  const auto second = again.next();
  const std::string size = test::input_error([&] { static_cast<void>(again.load(*second)); });
  EXPECT_NE(size.find("1.png: the mask has 20x10 pixels, record 1 has 64x48"), std::string::npos)
      << size;
}

TEST_F(Masks, OfZerosAndOnesOrOfLabelsAreRefused) {
  const GreyImage image(8, 4, 100);
  for (const int brightest : {1, 19, 127}) {
    cv::Mat mask(4, 8, CV_8UC1, cv::Scalar(brightest));
    mask.row(0) = 0;
    cv::imwrite((masks() / "0.png").string(), mask);
    const std::string said = test::input_error(
        [&] { static_cast<void>(read_mask(masks() / "0.png", image.view(), "image 0")); });
    EXPECT_NE(said.find("brightest value is " + std::to_string(brightest)), std::string::npos)
        << said;
    EXPECT_NE(said.find("write 255"), std::string::npos) << said;
  }
  cv::imwrite((masks() / "0.png").string(), cv::Mat(4, 8, CV_8UC1, cv::Scalar(0)));
  EXPECT_EQ(read_mask(masks() / "0.png", image.view(), "image 0").row(0)[0], 0);  // nothing is used
}

}  // namespace
}  // namespace oneac
