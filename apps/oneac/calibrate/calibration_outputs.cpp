#include "calibrate/calibration_outputs.h"

#include "run/run_outputs.h"

#include "oneac/base/input_file.h"
#include "oneac/base/median.h"
#include "oneac/base/number_text.h"
#include "oneac/base/version.h"
#include "oneac/geometry/angles.h"
#include "oneac/rawlog/calibration_writer.h"
#include "oneac/report/html_page.h"
#include "oneac/report/overlay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace oneac::app {
namespace {

// A focal length that is good to a per cent needs no better drive.
constexpr double kGood = 0.01;
constexpr std::size_t kRows = 4, kColumns = 8;  // of the residuals by region
// [-] 1σ that is still half of what was known before: the drive did not see it.
constexpr double kUnseen = 0.5;

// Of the first line of a file that the next calibration may replace.
constexpr const char* kMadeBy = "made by oneac calibrate";

std::string percent(double share) {
  return fixed_text(100.0 * share, 1) + " %";
}

/// One unknown with its unit.
struct Line {
  const char* name;
  double before, after, sigma;
  bool seen;
  int decimals;
};

std::vector<Line> lines_of(const Calibration& c) {
  const PinholeCamera& a = c.guess;
  const PinholeCamera& b = c.estimate.camera;
  const double f = b.focal_px();
  const auto sigma = [&](Intrinsic which) { return c.estimate.sigma(which); };
  const auto seen = [&](Intrinsic which, double prior) { return sigma(which) < kUnseen * prior; };
  return {
      {"fx [px]", a.fx, b.fx, f * sigma(kFocal), seen(kFocal, c.prior.focal), 2},
      {"fy [px]", a.fy, b.fy, b.fy * sigma(kFocal), seen(kFocal, c.prior.focal), 2},
      {"cx [px]", a.cx, b.cx, a.focal_px() * sigma(kCentreX), seen(kCentreX, c.prior.centre), 2},
      {"cy [px]", a.cy, b.cy, a.focal_px() * sigma(kCentreY), seen(kCentreY, c.prior.centre), 2},
      {"k1", a.distortion[0], b.distortion[0], sigma(kK1), seen(kK1, c.prior.k1), 4},
      {"k2", a.distortion[1], b.distortion[1], sigma(kK2), seen(kK2, c.prior.k2), 4}};
}

std::string text_of(const Line& line) {
  return std::string(line.name) + " = " + fixed_text(line.after, line.decimals) + " ± " +
         fixed_text(line.sigma, line.decimals) + (line.seen ? "" : " (not told by this drive)");
}

/// Median residual of each field; NaN where there are too few.
using Regions = std::array<double, kRows * kColumns>;

Regions regions_of(const Calibration& c, const PinholeCamera& camera) {
  std::array<std::vector<double>, kRows * kColumns> found;
  for (const CalibrationWindow& window : c.windows) {
    for (const SightingResidual& s : residuals_with(window, camera, {})) {
      const double column = std::floor(s.u.x() / camera.width * kColumns);
      const double row = std::floor(s.u.y() / camera.height * kRows);
      if (!(column >= 0 && column < kColumns && row >= 0 && row < kRows)) continue;
      found[static_cast<std::size_t>(row) * kColumns + static_cast<std::size_t>(column)].push_back(
          s.residual);
    }
  }
  constexpr std::size_t kFewest = 10;
  Regions regions;
  for (std::size_t i = 0; i < found.size(); ++i) {
    regions[i] = found[i].size() < kFewest ? NAN : upper_median(std::move(found[i]));
  }
  return regions;
}

std::string field_svg(std::size_t i, double value, double worst) {
  constexpr int kWide = 90, kHigh = 60;
  const auto x = std::to_string(kWide * static_cast<int>(i % kColumns));
  const auto y = std::to_string(kHigh * static_cast<int>(i / kColumns));
  if (!std::isfinite(value)) return "";
  const auto colour = colour_of(std::min(value / worst, 1.0));
  return "<rect x=\"" + x + "\" y=\"" + y + "\" width=\"88\" height=\"58\" fill=\"rgb(" +
         std::to_string(colour[0]) + "," + std::to_string(colour[1]) + "," +
         std::to_string(colour[2]) + ")\" fill-opacity=\"0.55\"/><text x=\"" + x + "\" y=\"" + y +
         "\" dx=\"44\" dy=\"36\" text-anchor=\"middle\" font-size=\"18\" fill=\"currentColor\">" +
         fixed_text(value, 2) + "</text>";
}

std::string regions_svg(const Regions& regions, double worst) {
  std::string svg = "<svg viewBox=\"0 0 720 240\" width=\"720\" role=\"img\">";
  for (std::size_t i = 0; i < regions.size(); ++i) svg += field_svg(i, regions[i], worst);
  return svg + "</svg>";
}

void add_regions(HtmlPage& page, const Calibration& c) {
  if (c.windows.empty()) return;
  const Regions before = regions_of(c, c.guess), after = regions_of(c, c.estimate.camera);
  double worst = 1e-3;
  for (const double value : before) worst = std::isfinite(value) ? std::max(worst, value) : worst;
  page.heading("Residuals by image region");
  page.paragraph(
      "Median distance of tracks from their landmarks in the bends [px], poses and "
      "depths fitted to each camera.");
  page.picture("with the camera that was guessed", regions_svg(before, worst));
  page.picture("with the camera that was found", regions_svg(after, worst));
}

Table unknowns_table(const Calibration& c) {
  Table table{"The camera", {"", "before", "found", "1σ", "told by this drive"}, {}};
  for (const Line& line : lines_of(c)) {
    table.rows.push_back({{line.name},
                          {fixed_text(line.before, line.decimals)},
                          {fixed_text(line.after, line.decimals)},
                          {fixed_text(line.sigma, line.decimals)},
                          {line.seen ? "yes" : "no"}});
  }
  return table;
}

Table bends_table(const Calibration& c) {
  Table table{"Bends", {"", "turn [deg]", "tracks", "residual [px]", "1σ of f alone [%]"}, {}};
  for (const IntrinsicsMeasurement& bend : c.bends) {
    const double alone = 1.0 / std::sqrt(bend.information(kFocal, kFocal));
    table.rows.push_back({{std::to_string(table.rows.size() + 1)},
                          {fixed_text(bend.turn / kDegree, 1)},
                          {std::to_string(bend.tracks)},
                          {fixed_text(bend.residual_px, 2)},
                          {fixed_text(100.0 * alone, 2)}});
  }
  return table;
}

std::string text_of(const TurnEvidence& turn, double focal_px) {
  const TurnMeasurement& m = turn.measured;
  return turn.sensor + " against the turns by images: f " +
         fixed_text(100.0 * std::expm1(m.log_focal), 2) + " ± " + fixed_text(100.0 * m.sigma, 2) +
         " % from the " + fixed_text(focal_px, 1) + " px of the last pass";
}

std::string mount_line(const Calibration& c) {
  const TiltBelief& tilt = c.drive.tilt_belief;
  return "camera looks " + fixed_text(tilt.tilt.pitch_up / kDegree, 2) + " ± " +
         fixed_text(tilt.pitch_sigma / kDegree, 2) + " deg above the horizon, leans " +
         fixed_text(tilt.tilt.roll_right / kDegree, 2) + " ± " +
         fixed_text(tilt.roll_sigma / kDegree, 2) + " deg to the right";
}

std::string metres_text(double metres, double relative_sigma) {
  return fixed_text(metres, 2) + " ± " + fixed_text(metres * relative_sigma, 2) + " m";
}

/// What each sensor says, in terms of the height that was assumed.
std::string sensors_text(const CameraHeight& height) {
  std::string text;
  for (const HeightEvidence& told : height.sensors) {
    const HeightMeasurement& m = told.measured;
    text += (text.empty() ? "" : "; ") + told.sensor + ": " +
            metres_text(height.assumed * m.ratio, m.sigma) + " by " + std::to_string(m.spans) +
            " stretches, " + fixed_text(m.way, 0) + " m";
  }
  return text;
}

/// The terms of a lens that are not learned; empty for one that has none.
std::string about_other_terms(const PinholeCamera& camera) {
  const auto& k = camera.distortion;
  if (camera.lens == LensModel::kannala_brandt) {
    return "fisheye with k3 = " + exact_text(k[2]) + ", k4 = " + exact_text(k[3]) +
           " as given: k2 has what they leave";
  }
  const bool any = std::any_of(k.begin() + 2, k.end(), [](double term) { return term != 0.0; });
  return any ? "p1, p2 and k3 to k6 as given: k2 has what they leave" : "";
}

/// What is not learned of the lens, then one per sensor that told something, or that cannot be what
/// it says.
std::vector<std::string> more_lines(const Calibration& c) {
  std::vector<std::string> lines;
  const std::string others = about_other_terms(c.estimate.camera);
  if (!others.empty()) lines.push_back(others);
  for (const TurnEvidence& turn : c.turns) lines.push_back(text_of(turn, c.drive.raw_camera.fx));
  for (const std::string& sensor : c.contradicting) {
    lines.push_back(sensor +
                    " contradicts what else tells the focal length and is not used; "
                    "1 sigma is wider for it");
  }
  const std::string strange = about_strange_gyroscope(c.drive);
  if (!strange.empty()) lines.push_back(strange);
  return lines;
}

}  // namespace

std::string verdict_of(const Calibration& c) {
  if (c.bends.empty() && c.agreeing.empty()) {
    return "this drive cannot tell the focal length: it turns by " +
           fixed_text(c.largest_turn / kDegree, 1) +
           " degrees within twelve keyframes at most; drive some bends of 30 degrees and more, "
           "near houses or parked cars";
  }
  if (c.bends.size() < IntrinsicsBelief::kFewestWindows && c.agreeing.empty()) {
    return "this drive has one bend only and nothing confirms what it says of the focal length; "
           "drive some bends of 30 degrees and more, near houses or parked cars";
  }
  const double sigma = c.estimate.sigma(kFocal);
  std::string bends = std::to_string(c.bends.size()) + (c.bends.size() == 1 ? " bend" : " bends");
  for (const std::string& sensor : c.agreeing) bends += ", " + sensor;
  if (!c.knows_focal()) {
    return "this drive hardly tells the focal length (" + percent(sigma) + " by " + bends +
           "); drive some bends of 30 degrees and more, near houses or parked cars";
  }
  const std::string good = "good to " + percent(sigma) + " in f (1 sigma, " + bends + ")";
  return sigma < kGood ? good : good + "; drive another bend for better";
}

std::string height_verdict(const CameraHeight& height) {
  const std::string sensors = sensors_text(height);
  if (!height.is_known()) {
    return "height of the camera not told: " + height.reason +
           (sensors.empty() ? "" : " (" + sensors + ")");
  }
  const std::string log = height.by_log > 0.0
                              ? "; the log's sensor pose says " + fixed_text(height.by_log, 2) +
                                    " m: one of both is wrong, check the unit of speeds"
                              : "";
  return "camera is " + metres_text(height.metres, height.sigma) + " above the road (" + sensors +
         ")" + log;
}

std::string height_yaml(const Calibration& c, const std::string& log) {
  if (!c.height.is_known()) return "";
  return "# " + std::string(kMadeBy) + " (oneac " + version() + ") of " + log +
         ": for --params, with the camera beside it\n# " + height_verdict(c.height) +
         "\nfront_end:\n  camera_height: " + fixed_text(c.height.metres, 3) +
         "\n  scale:\n    # of lengths by both\n    road_uncertainty: " +
         fixed_text(c.height.length_sigma, 3) + "\n";
}

bool is_made_by_calibrate(const std::filesystem::path& file) {
  constexpr std::size_t kBeginning = 400;  // [byte]
  const std::string beginning = beginning_of(file, kBeginning);
  // A YAML or an INI file, or the report.
  return beginning.substr(0, beginning.find('\n')).find(kMadeBy) != std::string::npos ||
         beginning.find("<title>oneac calibrate</title>") != std::string::npos;
}

std::string camera_ini(const Calibration& c, const std::string& log) {
  std::vector<std::string> remarks = {std::string(kMadeBy) + " (oneac " + version() + ") of " + log,
                                      verdict_of(c)};
  for (const Line& line : lines_of(c)) remarks.push_back(text_of(line));
  for (const std::string& line : more_lines(c)) remarks.push_back(line);
  remarks.push_back(mount_line(c));
  remarks.push_back(height_verdict(c.height));
  return calibration_text(c.estimate.camera, remarks);
}

std::string calibration_summary(const Calibration& c) {
  std::string text;
  for (const Line& line : lines_of(c)) text += text_of(line) + "\n";
  for (const std::string& line : more_lines(c)) text += line + "\n";
  return text + mount_line(c) + "\n" + height_verdict(c.height) + "\n" + verdict_of(c) + "\n";
}

std::string calibration_html(const Calibration& c, const std::string& log) {
  HtmlPage page("oneac calibrate", log + " · oneac " + version());
  page.warning(verdict_of(c));
  page.tiles({{"focal length [px]", fixed_text(c.estimate.camera.focal_px(), 1)},
              {"1σ", percent(c.estimate.sigma(kFocal))},
              {"bends", std::to_string(c.bends.size())},
              {"passes", std::to_string(c.passes)}});
  page.table(unknowns_table(c));
  for (const std::string& line : more_lines(c)) page.paragraph(line);
  page.paragraph(mount_line(c));
  page.paragraph(height_verdict(c.height));
  if (!c.bends.empty()) page.table(bends_table(c));
  add_regions(page, c);
  return page.text();
}

}  // namespace oneac::app
