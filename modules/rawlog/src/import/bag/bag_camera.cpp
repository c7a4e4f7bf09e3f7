#include "import/bag/bag_camera.h"

#include "calibration/calibration_numbers.h"

#include "oneac/geometry/camera_plausibility.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <tuple>

namespace oneac {
namespace {

constexpr double kSame_px = 0.01;   // as when a log is read
constexpr double kSameTerm = 1e-5;  // moves a point at half a focal length less than that

bool is_near(double a, double b, double tolerance) {
  return std::abs(a - b) <= tolerance;
}

template <class Numbers>
bool are_near(const Numbers& a, const Numbers& b, double tolerance) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](double x, double y) { return is_near(x, y, tolerance); });
}

constexpr const char* kGiveAnother = "give the calibration with --calibration FILE[:SECTION]";

void set_pixels(const RosCameraInfo& info, bool rectified, const CalibrationPlace& place,
                PinholeCamera& camera) {
  const std::vector<double> K(info.K.begin(), info.K.end()), P(info.P.begin(), info.P.end());
  set_matrix(rectified ? P : K, rectified ? "P" : "K", place, camera);
  if (!rectified) {
    const bool plain = info.distortion_model.empty() && info.D.empty();
    set_lens(plain ? "none" : info.distortion_model, info.D, place, camera);
  }
}

/// The images show a part of what K is for.
void cut(const RosCameraInfo& info, PinholeCamera& camera) {
  if (info.roi_width == 0 || info.roi_height == 0) return;
  camera.cx -= info.roi_x;
  camera.cy -= info.roi_y;
  camera.width = static_cast<int>(info.roi_width);
  camera.height = static_cast<int>(info.roi_height);
}

PinholeCamera binned(const RosCameraInfo& info, const PinholeCamera& camera,
                     const CalibrationPlace& place) {
  const std::uint32_t x = std::max(1U, info.binning_x), y = std::max(1U, info.binning_y);
  if (x == 1 && y == 1) return camera;
  const auto smaller = resized(camera, camera.width / static_cast<int>(std::min(x, 64U)),
                               camera.height / static_cast<int>(std::min(y, 64U)));
  if (smaller) return *smaller;
  place.fail("its binning is " + std::to_string(x) + " by " + std::to_string(y) +
                 ", other in one direction than in the other",
             kGiveAnother);
}

}  // namespace

bool is_rectified_topic(const std::string& topic) {
  static const std::set<std::string> kWords{"rect", "rectified"};
  std::string spaced = topic;
  std::replace_if(
      spaced.begin(), spaced.end(), [](char c) { return c == '/' || c == '_'; }, ' ');
  std::istringstream words(spaced);
  for (std::string word; words >> word;) {
    if (kWords.count(word) > 0) return true;
  }
  return false;
}

PinholeCamera camera_of(const RosCameraInfo& info, bool rectified, const CalibrationPlace& place) {
  constexpr std::uint32_t kLargest_px = 1U << 15U;
  if (info.K[0] == 0.0) {
    place.fail("it says that its camera is not calibrated (K is 0)", kGiveAnother);
  }
  if (info.width == 0 || info.height == 0 || std::max(info.width, info.height) > kLargest_px ||
      std::max({info.roi_x, info.roi_y, info.roi_width, info.roi_height}) > kLargest_px) {
    place.fail("it is for images of " + std::to_string(info.width) + "x" +
                   std::to_string(info.height) + " pixels",
               kGiveAnother);
  }
  PinholeCamera camera;
  camera.width = static_cast<int>(info.width);
  camera.height = static_cast<int>(info.height);
  set_pixels(info, rectified, place, camera);
  cut(info, camera);
  camera = binned(info, camera, place);
  if (const std::string fault = impossible_camera(camera); !fault.empty()) {
    place.fail(fault, kGiveAnother);
  }
  return camera;
}

bool needs_no_rectifying(const RosCameraInfo& info) {
  const std::array<double, 9> none{1, 0, 0, 0, 1, 0, 0, 0, 1};
  const bool no_lens = std::all_of(info.D.begin(), info.D.end(), [](double k) { return k == 0.0; });
  return no_lens && are_near(info.R, none, kSameTerm) && is_near(info.K[0], info.P[0], kSame_px) &&
         is_near(info.K[2], info.P[2], kSame_px) && is_near(info.K[5], info.P[6], kSame_px);
}

bool is_same_projection(const RosCameraInfo& a, const RosCameraInfo& b) {
  constexpr std::array<std::size_t, 4> kEntries{0, 2, 5, 6};  // fx, cx, fy, cy
  return std::all_of(kEntries.begin(), kEntries.end(),
                     [&](std::size_t i) { return is_near(a.P[i], b.P[i], kSame_px); });
}

double place_in_pair(const RosCameraInfo& info) {
  return -info.P[3] / info.P[0];
}

bool is_same_camera(const RosCameraInfo& a, const RosCameraInfo& b) {
  const auto whole = [](const RosCameraInfo& info) {
    return std::tie(info.width, info.height, info.distortion_model, info.binning_x, info.binning_y,
                    info.roi_x, info.roi_y, info.roi_width, info.roi_height);
  };
  return whole(a) == whole(b) && are_near(a.D, b.D, kSameTerm) && are_near(a.K, b.K, kSame_px) &&
         are_near(a.P, b.P, kSame_px);
}

}  // namespace oneac
