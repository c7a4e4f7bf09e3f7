// oneac_fuzz_seeds FOLDER: small rawlogs with every kind of image and sensor, and image files.
#include "log_maker.h"

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <cstdio>

namespace oneac {
namespace {

namespace fs = std::filesystem;
using test::Objects;
using test::Packing;

constexpr int kShrink = 4;

cv::Mat small(int type) {
  cv::Mat image;
  cv::resize(test::ramp(40), image, {test::kWidth / kShrink, test::kHeight / kShrink});
  if (type == CV_8UC3) cv::cvtColor(image, image, cv::COLOR_GRAY2BGR);
  if (type == CV_16U) image.convertTo(image, CV_16U, 256.0);
  return image;
}

mrpt::obs::CObservationImage::Ptr stored(const std::string& label, double time, int type) {
  auto image = test::stored_image(label, time, small(type));
  image->cameraParams.ncols /= kShrink;
  image->cameraParams.nrows /= kShrink;
  return image;
}

Objects images() {
  return {stored("GREY", 0, CV_8U), stored("COLOUR", 0, CV_8UC3), stored("WIDE", 0, CV_16U),
          stored("GREY", 1, CV_8U)};
}

Objects pairs() {
  return {test::external_pair("PAIR", 0, "a"), test::external_pair("PAIR", 1, "b")};
}

Objects sensors() {
  auto imu = mrpt::obs::CObservationIMU::Create();
  imu->sensorLabel = "IMU";
  imu->timestamp = test::rmc(0, 0, 0)->timestamp;
  imu->set(mrpt::obs::IMU_Z_ACC, 9.81);
  auto scan = mrpt::obs::CObservation2DRangeScan::Create();
  scan->sensorLabel = "LASER";
  scan->resizeScanAndAssign(7, 12.5F, true);
  return {imu, scan, test::gga(0, 36.7, -4.4, 70), test::rmc(0, 10, 90)};
}

Objects frames() {
  auto frame = mrpt::obs::CSensoryFrame::Create();
  *frame += mrpt::obs::CObservation::Ptr(stored("GREY", 0, CV_8U));
  *frame += mrpt::obs::CObservation::Ptr(test::rmc(0, 10, 90));
  return {mrpt::obs::CActionCollection::Create(), frame};
}

void write_seeds(const fs::path& folder) {
  fs::create_directories(folder / "rawlog_source");
  fs::create_directories(folder / "image");
  const fs::path logs = folder / "rawlog_source";
  mrpt::img::CImage::DISABLE_JPEG_COMPRESSION(true);
  test::write_log(logs / "images", images());
  mrpt::img::CImage::DISABLE_JPEG_COMPRESSION(false);
  test::write_log(logs / "jpeg_images", images());
  test::write_log(logs / "pairs", pairs());
  test::write_log(logs / "sensors", sensors());
  test::write_log(logs / "frames", frames());
  test::write_log(logs / "pairs.gz", pairs(), Packing::gzip);
  test::write_log(logs / "sensors.zst", sensors(), Packing::zstd);
  for (const char* name : {"grey.png", "grey.jpg", "grey.bmp", "grey.pgm"}) {
    cv::imwrite((folder / "image" / name).string(), small(CV_8U));
  }
  cv::imwrite((folder / "image" / "wide.png").string(), small(CV_16U));
  cv::imwrite((folder / "image" / "colour.jpg").string(), small(CV_8UC3));
}

}  // namespace
}  // namespace oneac

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "oneac_fuzz_seeds FOLDER\n");
    return 2;
  }
  oneac::write_seeds(argv[1]);
  return 0;
}
