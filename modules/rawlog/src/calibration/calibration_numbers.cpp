#include "calibration/calibration_numbers.h"

#include "oneac/base/error.h"
#include "oneac/base/finite_number.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

namespace oneac {
namespace {

constexpr const char* kPlainLens = "rectify the images and give their calibration";
constexpr std::size_t kFisheyeTerms = 4;
constexpr double kLargestSide_px = 1e6;

std::string plain(const std::string& name) {
  std::string letters;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) != 0) letters += static_cast<char>(std::tolower(byte));
  }
  return letters;
}

bool is_fisheye(const std::string& plain_name) {
  static const std::set<std::string> kNames{"equidistant", "fisheye", "kannalabrandt",
                                            "kannalabrandt4", "kannalabrandt8"};
  return kNames.count(plain_name) != 0;
}

bool is_polynomial(const std::string& plain_name) {
  static const std::set<std::string> kNames{"plumbbob", "radtan",  "radialtangential",
                                            "rational", "pinhole", "rationalpolynomial"};
  return kNames.count(plain_name) != 0;
}

}  // namespace

void CalibrationPlace::fail(const std::string& fault, const std::string& cure) const {
  throw InputError(file_.string() + ": " + place_, fault, cure);
}

std::vector<double> CalibrationPlace::numbers(const std::string& key,
                                              const std::vector<std::string>& words) const {
  constexpr std::size_t kShown = 40;
  std::vector<double> values;
  for (const std::string& word : words) {
    const auto value = finite_number(word);
    if (!value) {
      fail(key + " holds '" + word.substr(0, kShown) + "', which is not a number",
           "write it as the tool does, or calibrate again");
    }
    values.push_back(*value);
  }
  return values;
}

void set_size(const std::vector<double>& size, const std::string& key,
              const CalibrationPlace& place, PinholeCamera& camera) {
  if (size.empty()) return;
  const auto is_side = [](double side) {
    return side >= 1.0 && side < kLargestSide_px && side == std::floor(side);
  };
  if (size.size() != 2 || !is_side(size[0]) || !is_side(size[1])) {
    place.fail(key + " is not [width height] in whole pixels", "give the size of its images");
  }
  camera.width = static_cast<int>(size[0]);
  camera.height = static_cast<int>(size[1]);
}

void set_intrinsics(const std::vector<double>& four, const std::string& key,
                    const CalibrationPlace& place, PinholeCamera& camera) {
  if (four.size() != 4) {
    place.fail(key + " has " + std::to_string(four.size()) + " numbers",
               "it needs four: fx, fy, cx, cy in pixels");
  }
  if (!(four[0] > 0.0 && four[1] > 0.0)) {
    place.fail(key + ": the focal length is not positive", "give fx and fy in pixels");
  }
  camera.fx = four[0];
  camera.fy = four[1];
  camera.cx = four[2];
  camera.cy = four[3];
}

void set_matrix(const std::vector<double>& entries, const std::string& key,
                const CalibrationPlace& place, PinholeCamera& camera) {
  if (entries.size() != 9 && entries.size() != 12) {
    place.fail(key + " has " + std::to_string(entries.size()) + " numbers",
               "it needs the nine of K or the twelve of P, by rows");
  }
  const std::size_t columns = entries.size() / 3;
  const auto at = [&](std::size_t row, std::size_t column) {
    return entries[row * columns + column];
  };
  const bool pinhole =
      at(0, 1) == 0.0 && at(1, 0) == 0.0 && at(2, 0) == 0.0 && at(2, 1) == 0.0 && at(2, 2) == 1.0;
  if (!pinhole) {
    place.fail(key + " is no [fx 0 cx; 0 fy cy; 0 0 1]",
               "skewed pixels and other scales are not supported: calibrate without");
  }
  set_intrinsics({at(0, 0), at(1, 1), at(0, 2), at(1, 2)}, key, place, camera);
}

void set_lens(const std::string& model, const std::vector<double>& coefficients,
              const CalibrationPlace& place, PinholeCamera& camera) {
  const std::string name = plain(model);
  if (name == "none" || name == "rectified") return;
  const bool fisheye = is_fisheye(name);
  if (!fisheye && !is_polynomial(name)) {
    place.fail("the lens model '" + model + "' is not supported", kPlainLens);
  }
  const std::size_t most = fisheye ? kFisheyeTerms : camera.distortion.size();
  for (std::size_t i = most; i < coefficients.size(); ++i) {
    if (coefficients[i] != 0.0) {
      place.fail("the lens has terms beyond " +
                     std::string(fisheye ? "k1 k2 k3 k4" : "k1 k2 p1 p2 k3 k4 k5 k6"),
                 kPlainLens);
    }
  }
  std::copy_n(coefficients.begin(), std::min(coefficients.size(), most), camera.distortion.begin());
  if (fisheye) camera.lens = LensModel::kannala_brandt;
}

}  // namespace oneac
