// The right images beside KITTI's left ones, and whether the two are a rectified pair.
#include "calibration/calibration_numbers.h"
#include "import/image_drive.h"
#include "read/calibration_file.h"

#include "oneac/base/number_text.h"

#include <cmath>
#include <sstream>

namespace oneac {
namespace {

namespace fs = std::filesystem;

/// A 3×4 projection of a rectified camera; tx = -fx · (its place along X).
struct Projection {
  double fx, fy, cx, cy, tx;
};

std::optional<Projection> projection_of(const CalibrationFile& file, const std::string& name) {
  const auto section = file.sections.find(name);
  if (section == file.sections.end() || section->second.count(kKittiKey) == 0) return std::nullopt;
  std::istringstream stream(section->second.at(kKittiKey));
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  const CalibrationPlace place(file.path, "section [" + name + "]");
  const std::vector<double> P = place.numbers(name, words);
  constexpr std::size_t kEntries = 12;
  if (P.size() != kEntries || !(P[0] > 0.0)) return std::nullopt;
  return Projection{P[0], P[5], P[2], P[6], P[3]};
}

/// What parts two cameras beside their place: "fx 300, not 250"; "" for those of a rectified pair.
std::string difference(const Projection& left, const Projection& right) {
  constexpr double kSame_px = 0.01;  // as when a log is read
  struct Term {
    const char* name;
    double left, right;
  };
  for (const Term& term : {Term{"fx", left.fx, right.fx}, Term{"fy", left.fy, right.fy},
                           Term{"cx", left.cx, right.cx}, Term{"cy", left.cy, right.cy}}) {
    if (std::abs(term.left - term.right) <= kSame_px) continue;
    return std::string(term.name) + " " + exact_text(term.right) + ", not " + exact_text(term.left);
  }
  return "";
}

}  // namespace

std::optional<RightImages> kitti_right_images(const std::vector<fs::path>& left,
                                              const fs::path& folder, const fs::path& calibration,
                                              const std::string& left_projection,
                                              const std::string& right_projection,
                                              ImportReport& report) {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) return std::nullopt;
  const CalibrationFile file = read_calibration_file(calibration);
  const auto P0 = projection_of(file, left_projection), P1 = projection_of(file, right_projection);
  const auto leave_out = [&](const std::string& why) {
    report.notes.push_back(folder.string() + " is left out: " + why);
    return std::nullopt;
  };
  if (!P0 || !P1) {
    return leave_out(calibration.filename().string() + " has no " +
                     (P1 ? left_projection : right_projection));
  }
  if (const std::string other = difference(*P0, *P1); !other.empty()) {
    return leave_out(right_projection + " is no camera of a rectified pair with " +
                     left_projection + ": " + other);
  }
  RightImages right;
  right.baseline_m = P0->tx / P0->fx - P1->tx / P1->fx;
  if (!is_baseline(right.baseline_m)) {
    return leave_out(right_projection + " is " + exact_text(right.baseline_m) +
                     " m to the right of " + left_projection);
  }
  std::size_t there = 0;
  for (const fs::path& image : left) {
    const fs::path other = folder / image.filename();
    const bool exists = fs::is_regular_file(other, ignored);
    right.images.push_back(exists ? other : fs::path());
    there += exists ? 1U : 0U;
  }
  if (there == 0) return leave_out("no image in it has the name of a left one");
  report.notes.push_back(std::to_string(there) + " right images of " + std::to_string(left.size()) +
                         ", " + fixed_text(right.baseline_m, 3) + " m beside the left ones");
  return right;
}

std::optional<RightImages> given_right_images(const std::vector<fs::path>& left,
                                              const fs::path& folder, const std::string& given,
                                              const std::string& left_projection,
                                              const std::string& right_projection,
                                              ImportReport& report) {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) return std::nullopt;
  const CalibrationName name = calibration_name(given);
  if (name.section.empty() || name.section == left_projection) {
    return kitti_right_images(left, folder, name.file, left_projection, right_projection, report);
  }
  report.notes.push_back(folder.string() + " is left out: the calibration is " + name.section +
                         ", and its images belong to those of " + left_projection);
  return std::nullopt;
}

}  // namespace oneac
