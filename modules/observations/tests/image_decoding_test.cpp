#include "oneac/observations/image_decoding.h"

#include "log_maker.h"

#include "oneac/test_support/temporary_folder.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

namespace oneac {
namespace {

class ImageDecoding : public ::testing::Test {
 protected:
  std::filesystem::path save(const std::string& name, const cv::Mat& pixels) {
    cv::imwrite((folder_.path() / name).string(), pixels);
    return folder_.path() / name;
  }
  static std::string fault(const std::filesystem::path& file) {
    return test::input_error([&] { static_cast<void>(decode_grey_file(file)); });
  }
  TemporaryFolder folder_;
};

bool same(GreyImage image, const cv::Mat& grey) {
  const cv::Mat pixels(image.height(), image.width(), CV_8U, image.row(0));
  return pixels.size() == grey.size() && cv::norm(pixels, grey, cv::NORM_INF) <= 1.0;
}

TEST_F(ImageDecoding, ConvertsEveryKindToTheSameGrey) {
  const cv::Mat grey = test::ramp(40);
  cv::Mat colour;
  cv::Mat with_alpha;
  cv::Mat wide;
  cv::cvtColor(grey, colour, cv::COLOR_GRAY2BGR);
  cv::cvtColor(grey, with_alpha, cv::COLOR_GRAY2BGRA);
  grey.convertTo(wide, CV_16U, 256.0);
  EXPECT_TRUE(same(decode_grey_file(save("grey.png", grey)), grey));
  EXPECT_TRUE(same(decode_grey_file(save("colour.png", colour)), grey));
  EXPECT_TRUE(same(decode_grey_file(save("alpha.png", with_alpha)), grey));
  EXPECT_TRUE(same(decode_grey_file(save("wide.png", wide)), grey));
  EXPECT_TRUE(same(to_grey(colour, "c"), grey));
  EXPECT_TRUE(same(to_grey(with_alpha, "a"), grey));
  EXPECT_TRUE(same(to_grey(wide, "w"), grey));
}

std::vector<std::uint8_t> bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST_F(ImageDecoding, ReadsTiffAndWebp) {
  const cv::Mat grey = test::ramp(40);
  cv::Mat wide, colour;
  grey.convertTo(wide, CV_16U, 256.0);
  cv::cvtColor(grey, colour, cv::COLOR_GRAY2BGR);
  EXPECT_TRUE(same(decode_grey_file(save("grey.tif", grey)), grey));
  EXPECT_TRUE(same(decode_grey_file(save("wide.tiff", wide)), grey));
  const auto lossless = folder_.path() / "colour.webp";
  cv::imwrite(lossless.string(), colour, {cv::IMWRITE_WEBP_QUALITY, 101});
  EXPECT_TRUE(same(decode_grey_file(lossless), grey));
  const GreyImage lossy = decode_grey_file(save("lossy.webp", colour));
  EXPECT_EQ(lossy.width(), grey.cols);
  EXPECT_EQ(lossy.height(), grey.rows);
}

TEST_F(ImageDecoding, RefusesTiffAndWebpThatClaimAnAbsurdSize) {
  auto tiff = bytes_of(save("grey.tif", test::ramp(40)));
  const std::size_t directory = tiff[4] + 256U * tiff[5] + 65536U * tiff[6];
  for (std::size_t at = directory + 2; at + 12 <= tiff.size(); at += 12) {
    if (tiff[at + 1] != 1 || tiff[at] > 1) continue;  // width or height, 256 or 257
    tiff[at + 2] = 4;                                 // LONG
    tiff[at + 10] = 15;
  }
  const auto told = [](const std::vector<std::uint8_t>& bytes) {
    return test::input_error([&] { static_cast<void>(decode_grey_bytes(bytes, "x")); });
  };
  EXPECT_NE(told(tiff).find("absurd size"), std::string::npos) << told(tiff);
  std::vector<std::uint8_t> webp(40, 0);
  const std::string head("RIFF....WEBPVP8X");
  std::copy(head.begin(), head.end(), webp.begin());
  std::fill(webp.begin() + 24, webp.begin() + 30, std::uint8_t{255});
  EXPECT_NE(told(webp).find("absurd size"), std::string::npos) << told(webp);
  webp[15] = 'Y';
  EXPECT_NE(told(webp).find("no JPEG"), std::string::npos) << told(webp);
}

TEST_F(ImageDecoding, TakesAnImageOfALogForWhatMrptMakesOfIt) {
  cv::Mat colour(48, 64, CV_8UC3);
  cv::randu(colour, 0, 255);  // saturated: the luminance of the JPEG is another grey
  std::vector<std::uint8_t> jpeg;
  cv::imencode(".jpg", colour, jpeg);
  cv::Mat grey;
  cv::cvtColor(cv::imdecode(jpeg, cv::IMREAD_COLOR), grey, cv::COLOR_BGR2GRAY);
  GreyImage decoded = decode_grey_by_colour(jpeg, "record 3");
  const cv::Mat pixels(48, 64, CV_8U, decoded.row(0));
  EXPECT_EQ(cv::norm(pixels, grey, cv::NORM_INF), 0.0);
}

TEST_F(ImageDecoding, RefusesACutJpegInsteadOfFillingItWithGrey) {
  const auto file = save("cut.jpg", test::ramp(0));
  EXPECT_EQ(fault(file), "");
  std::ifstream in(file, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  bytes.resize(bytes.size() - 20);
  test::write_bytes(file, bytes);
  EXPECT_NE(fault(file).find("cut.jpg: the image ends early"), std::string::npos);
}

TEST_F(ImageDecoding, NamesTheFileThatIsNoImage) {
  test::write_bytes(folder_.path() / "text.png", "not an image");
  test::write_bytes(folder_.path() / "empty.png", "");
  EXPECT_NE(fault(folder_.path() / "text.png").find("text.png"), std::string::npos);
  EXPECT_NE(fault(folder_.path() / "empty.png").find("is empty"), std::string::npos);
  EXPECT_NE(fault(folder_.path() / "none.png").find("cannot be opened"), std::string::npos);
  EXPECT_THROW(static_cast<void>(to_grey(cv::Mat(4, 4, CV_32F), "float")), InputError);
}

TEST_F(ImageDecoding, ScalesFewerBitsInSixteenByTheRangeInUse) {
  const cv::Mat grey = test::ramp(40);
  for (const double bits : {10.0, 12.0, 14.0, 16.0}) {
    cv::Mat wide;
    grey.convertTo(wide, CV_16U, std::exp2(bits - 8.0));
    wide.at<std::uint16_t>(0, 0) = static_cast<std::uint16_t>(std::exp2(bits) - 1.0);  // the sky
    cv::Mat expected = grey.clone();
    expected.at<std::uint8_t>(0, 0) = 255;
    EXPECT_TRUE(same(decode_grey_file(save("wide.png", wide)), expected)) << bits << " bits";
  }
}

TEST_F(ImageDecoding, GivesTheImagesOfADriveOneRangeOfSixteenBits) {
  cv::Mat day, night, sun;
  test::ramp(150).convertTo(day, CV_16U, 16.0);  // 12 bits
  test::ramp(10).convertTo(night, CV_16U, 8.0);  // by itself 10 bits
  test::ramp(150).convertTo(sun, CV_16U, 256.0);
  GreyRange drive;
  EXPECT_EQ(to_grey(day, "day", drive).row(0)[40], 190);
  EXPECT_EQ(to_grey(night, "night", drive).row(0)[40], 25);
  EXPECT_EQ(to_grey(night, "night").row(0)[40], 100);
  EXPECT_EQ(to_grey(sun, "brighter than the first", drive).row(0)[40], 190);
  EXPECT_EQ(to_grey(day, "day", drive).row(0)[40], 190);
}

}  // namespace
}  // namespace oneac
