#include "read/guarded_stream.h"

#include "log_maker.h"
#include "read/log_reader.h"

#include "oneac/observations/image_decoding.h"
#include "oneac/rawlog/rawlog_source.h"
#include "oneac/test_support/peak_memory.h"
#include "oneac/test_support/temporary_folder.h"

#include <gtest/gtest.h>
#include <mrpt/img/CImage.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <opencv2/imgproc.hpp>

namespace oneac {
namespace {

using test::Packing;

class Guarded : public ::testing::Test {
 protected:
  /// Reads the log to its end; the damage, "" without.
  std::string damage_of(const std::string& bytes) {
    test::write_bytes(file_, bytes);
    return test::input_error([this] {
      LogReader reader(file_);
      observations_ = 0;
      while (reader.next()) ++observations_;
      if (reader.damage()) throw InputError(*reader.damage());
    });
  }
  /// The only frame of a log with this image.
  GreyImage through_a_log(const cv::Mat& pixels) {
    test::write_log(file_, {test::stored_image("CAM", 0, pixels)});
    RawlogSource source({file_, {}, "", "", "auto", {}, 0, 0, 1, false, 0.0, {}});
    return source.load(source.next().value()).image;
  }
  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "drive.rawlog";
  std::size_t observations_ = 0;
};

/// The bytes with the 32-bit number before `text` replaced.
std::string with_length_before(std::string bytes, const std::string& text, std::uint32_t length) {
  const std::size_t at = bytes.rfind(text);
  for (std::size_t i = 0; i < 4; ++i)
    bytes[at - 4 + i] = static_cast<char>(length >> (8 * i) & 0xffU);
  return bytes;
}

TEST_F(Guarded, ALengthBeyondTheFileTakesNoMemory) {
  const std::string whole =
      test::packed({test::rmc(0, 1, 1), test::rmc(1, 1, 1), test::rmc(2, 1, 1)});
  const std::size_t before = peak_mb();
  for (const std::uint32_t length : {0xffffffffU, 0x7fffffffU, 0x10000000U, 0x00100000U}) {
    const std::string damage = damage_of(with_length_before(whole, "GPS", length));
    EXPECT_NE(damage.find("record 2"), std::string::npos) << damage;
    EXPECT_EQ(observations_, 2U);
  }
  EXPECT_LT(peak_mb(), before + 50U);
}

// Three of the four bytes of the number of actions.
TEST_F(Guarded, ACountOfWhichTheFileHasAPartTakesNoMemory) {
  const std::string name = "CActionCollection";
  const std::string shell = static_cast<char>(0x80U | name.size()) + name + '\0';
  const std::size_t before = peak_mb();
  const std::string damage =
      damage_of(test::packed({test::rmc(0, 1, 1)}) + shell + std::string({'*', 0, '['}));
  EXPECT_NE(damage.find("record 1"), std::string::npos) << damage;
  EXPECT_LT(peak_mb(), before + 50U);
}

// Three numbers in a row: the camera's width, the length of its name, the name's letters.
TEST_F(Guarded, ALengthThatLooksLikeALabelTakesNoMemory) {
  auto image = test::stored_image("CAM", 0, test::ramp(0));
  image->cameraParams.ncols = 4;
  image->cameraParams.cameraName = "NAME";
  const std::string whole = test::packed({test::rmc(0, 1, 1), image});
  const std::size_t before = peak_mb();
  for (const std::uint32_t letters : {0x20202020U, 0x41414141U, 0x7e7e7e7eU}) {
    const std::string damage = damage_of(with_length_before(whole, "NAME", letters));
    EXPECT_NE(damage.find("record 1"), std::string::npos) << damage;
  }
  EXPECT_LT(peak_mb(), before + 50U);
}

TEST_F(Guarded, ADepthImageLargerThanAnySensorsTakesNoMemory) {
  auto scan = mrpt::obs::CObservation3DRangeScan::Create();
  scan->hasRangeImage = true;
  scan->rangeImage.setZero(37, 41);
  std::string bytes = test::packed({test::rmc(0, 1, 1), scan});
  const std::size_t rows = bytes.find(std::string({37, 0, 0, 0, 41, 0, 0, 0}));
  ASSERT_NE(rows, std::string::npos);
  bytes.replace(rows, 8, std::string({'\0', '\x70', 0, 0, '\0', '\x70', 0, 0}));  // 28672 each
  const std::size_t before = peak_mb();
  const std::string damage = damage_of(bytes);
  EXPECT_NE(damage.find("record 1"), std::string::npos) << damage;
  EXPECT_LT(peak_mb(), before + 50U);
}

// One wrong byte makes a CObservationGPS one: MRPT says so on stderr, beside our one line.
TEST_F(Guarded, AnAbstractClassEndsTheLogInSilence) {
  std::string bytes = test::packed({test::rmc(0, 1, 1), test::rmc(1, 1, 1)});
  const std::string whole_name = "CObservationGPS";
  const std::string abstract_name = "CObservation";
  bytes[bytes.rfind(whole_name) - 1] = static_cast<char>(0x80U | abstract_name.size());
  testing::internal::CaptureStderr();
  const std::string damage = damage_of(bytes);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_NE(damage.find("record 1"), std::string::npos) << damage;
  EXPECT_EQ(observations_, 1U);
}

TEST_F(Guarded, AClassNameEndsAtItsFirstZeroAsForMrpt) {
  std::string bytes = test::packed({test::stored_image("CAM", 0, test::ramp(0))});
  const std::string name = "mrpt::img::CImage";
  const std::size_t at = bytes.find(name);
  ASSERT_NE(at, std::string::npos);
  ++bytes[at - 1];
  bytes.insert(at + name.size(), 1, '\0');
  test::write_bytes(file_, bytes);
  LogReader reader(file_);
  EXPECT_EQ(reader.next().value().images->size(), 1U) << "MRPT has read the image";
}

TEST_F(Guarded, AnImageBeyondTheFileTakesNoMemory) {
  const std::string whole =
      test::packed({test::rmc(0, 1, 1), test::stored_image("CAM", 0, test::ramp(0))});
  const std::size_t before = peak_mb();
  // version, external?, colour?, then width and height
  const std::size_t image = whole.find("CImage") + 6 + 3;
  for (const char byte : {'\x7f', '\xff', '\x20'}) {
    std::string bytes = whole;
    bytes[image + 3] = bytes[image + 7] = byte;
    const std::string damage = damage_of(bytes);
    EXPECT_NE(damage.find("record 1"), std::string::npos) << damage;
  }
  EXPECT_LT(peak_mb(), before + 50U);
}

TEST_F(Guarded, ObjectsNestedWithoutEndAreRefused) {
  std::string bytes = test::packed({test::rmc(0, 1, 1)});
  const std::string name = "CSensoryFrame";
  const std::string shell = static_cast<char>(0x80U | name.size()) + name + '\2' +
                            std::string({1, 0, 0, 0});  // version 2, one observation in it
  for (int i = 0; i < 100000; ++i) bytes += shell;
  const std::string damage = damage_of(bytes);
  EXPECT_NE(damage.find("record 1"), std::string::npos) << damage;
}

TEST_F(Guarded, AnImageOfVersionZeroIsRefusedBecauseMrptWritesPastItsEnd) {
  std::string bytes =
      test::packed({test::rmc(0, 1, 1), test::stored_image("CAM", 0, test::ramp(0))});
  bytes[bytes.find("CImage") + 6] = '\0';
  const std::string damage = damage_of(bytes);
  EXPECT_NE(damage.find("record 1"), std::string::npos) << damage;
}

TEST_F(Guarded, ARecordWithoutEndMarkThatIsCutIsDamage) {
  // As written before 2007: the class's length and version in four bytes, no mark at the end.
  std::string bytes = test::packed({test::rmc(0, 1, 1)});
  const std::string name = "CObservationComment";
  bytes += static_cast<char>(name.size()) + std::string(3, '\0') + name + std::string(4, '\0');
  EXPECT_NE(damage_of(bytes), "");
  bytes += std::string({5, 0, 0, 0}) + "hel";
  EXPECT_NE(damage_of(bytes).find("record 1"), std::string::npos);
}

TEST_F(Guarded, NumbersThatAreNotCountsDoNotEndTheLog) {
  auto scan = mrpt::obs::CObservation2DRangeScan::Create();
  scan->sensorLabel = "LASER";
  scan->aperture = 3.0F;
  scan->maxRange = 80.0F;
  scan->resizeScanAndAssign(361, 12.5F, true);
  const std::string damage = damage_of(test::packed({scan, test::rmc(0, 1, 1)}));
  EXPECT_EQ(damage, "");
  EXPECT_EQ(observations_, 2U);
}

TEST_F(Guarded, LabelsOfFourLettersAreNoCounts) {
  auto gps = test::rmc(0, 1, 1);
  for (const char* label : {"GPS1", "~~~~",
                            "K\xc3\xbc"
                            "1"}) {
    gps->sensorLabel = label;
    test::write_log(file_, {gps});
    EXPECT_EQ(LogReader(file_).next()->observation->sensorLabel, label);
  }
}

// MRPT reads their names into a local variable.
TEST_F(Guarded, LayersOfFourLettersKeepTheirNames) {
  auto scan = mrpt::obs::CObservation3DRangeScan::Create();
  scan->rangeImageOtherLayers["NEAR"].setZero(3, 5);
  test::write_log(file_, {scan});
  LogReader reader(file_);
  const auto record = reader.next();
  ASSERT_TRUE(record) << reader.damage()->what();
  const auto& read = dynamic_cast<const mrpt::obs::CObservation3DRangeScan&>(*record->observation);
  EXPECT_EQ(read.rangeImageOtherLayers.count("NEAR"), 1U);
}

TEST_F(Guarded, StoredImagesComeThroughWithTheirPixels) {
  const cv::Mat grey = test::ramp(30);
  cv::Mat wide;
  cv::Mat colour;
  grey.convertTo(wide, CV_16U, 256.0);
  cv::cvtColor(grey, colour, cv::COLOR_GRAY2BGR);
  for (const cv::Mat& pixels : {grey, wide, colour}) {
    const GreyImage image = through_a_log(pixels);
    ASSERT_EQ(image.width(), test::kWidth);
    for (const int u : {0, 20, 63}) {
      EXPECT_NEAR(image.view().data[20 * image.view().stride + u], 30 + u, 3) << pixels.type();
    }
  }
}

TEST_F(Guarded, ColourImagesComeThroughRawAndCompressed) {
  cv::Mat colour;
  cv::cvtColor(test::ramp(30), colour, cv::COLOR_GRAY2BGR);
  const bool before = mrpt::img::CImage::DISABLE_JPEG_COMPRESSION();
  for (const bool raw : {true, false}) {
    mrpt::img::CImage::DISABLE_JPEG_COMPRESSION(raw);
    const GreyImage image = through_a_log(colour);
    EXPECT_NEAR(image.view().data[20 * image.view().stride + 20], 50, raw ? 1 : 3);
  }
  mrpt::img::CImage::DISABLE_JPEG_COMPRESSION(before);
}

TEST_F(Guarded, ImagesInsideASensoryFrameStayApart) {
  auto frame = mrpt::obs::CSensoryFrame::Create();
  *frame += mrpt::obs::CObservation::Ptr(test::stored_image("A", 0, test::ramp(10)));
  *frame += mrpt::obs::CObservation::Ptr(test::stored_image("B", 0, test::ramp(90)));
  test::write_log(file_, {frame});
  RawlogSource source({file_, {}, "B", "", "auto", {}, 0, 0, 1, false, 0.0, {}});
  EXPECT_EQ(source.load(source.next().value()).image.view().data[0], 90);
}

TEST_F(Guarded, APoseThatIsNoRotationIsDamage) {
  auto image = test::stored_image("CAM", 1, test::ramp(0));
  test::Objects objects{test::stored_image("CAM", 0, test::ramp(0)), image};
  std::string bytes = test::packed(objects);
  // The quaternion (1, 0, 0, 0) of the second camera's pose.
  const std::size_t pose = bytes.rfind("CPose3D");
  const std::size_t one = bytes.find(std::string("\x00\x00\x00\x00\x00\x00\xf0\x3f", 8), pose);
  ASSERT_NE(one, std::string::npos);
  bytes[one + 7] = '\x41';
  EXPECT_NE(damage_of(bytes).find("record 1: "), std::string::npos);
}

}  // namespace
}  // namespace oneac
