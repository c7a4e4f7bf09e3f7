#include "oneac/evaluation/relative_poses_io.h"

#include "text_io.h"

#include "oneac/base/error.h"
#include "oneac/base/input_file.h"
#include "oneac/base/number_text.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string_view>

namespace oneac {
namespace {

constexpr std::array<std::string_view, 16> kColumns{
    "index1", "index2", "t1", "t2",     "qw",      "qx",  "qy",     "qz",
    "tx",     "ty",     "tz", "metric", "inliers", "acs", "status", "sigma_length"};
constexpr std::size_t kRequired = 15;  // files from before had no sigma_length
constexpr auto kNowhere = std::numeric_limits<std::size_t>::max();
constexpr double kUnitTolerance = 1e-3;  // four digits of a quaternion are enough to be one

std::string header() {
  std::string line;
  for (const auto column : kColumns) line += (line.empty() ? "" : ",") + std::string(column);
  return line;
}

using ColumnPlaces = std::array<std::size_t, kColumns.size()>;

ColumnPlaces find_columns(const TextLine& line, const std::string& file) {
  const auto names = split_at_commas(line.text);
  ColumnPlaces places{};
  for (std::size_t c = 0; c < kColumns.size(); ++c) {
    const auto found = std::find(names.begin(), names.end(), kColumns[c]);
    places[c] = kNowhere;
    if (found == names.end() && c >= kRequired) continue;
    if (found == names.end()) {
      throw InputError(where_in(file, line.number), "no column '" + std::string(kColumns[c]) + "'",
                       "the first line must be " + header());
    }
    places[c] = static_cast<std::size_t>(found - names.begin());
  }
  return places;
}

/// The fields of one line, found by the name of their column.
class Fields {
 public:
  Fields(const TextLine& line, const ColumnPlaces& places, const std::string& file)
      : fields_(split_at_commas(line.text)), places_(places), where_(where_in(file, line.number)) {
    std::size_t needed = 0;
    for (const std::size_t place : places) {
      if (place != kNowhere) needed = std::max(needed, place + 1);
    }
    if (fields_.size() >= needed) return;
    throw InputError(where_,
                     std::to_string(fields_.size()) + " fields, needs " + std::to_string(needed),
                     "write the file again, or remove the line when it was cut");
  }

  /// Empty for a column that the file does not have.
  [[nodiscard]] std::string_view text(std::string_view column) const {
    const auto at = std::find(kColumns.begin(), kColumns.end(), column) - kColumns.begin();
    const std::size_t place = places_[static_cast<std::size_t>(at)];
    return place == kNowhere ? std::string_view{} : fields_[place];
  }
  [[nodiscard]] double real(std::string_view column) const {
    const auto value = parse_finite(text(column));
    if (!value) fail(column, "a finite number below 1e15");
    return *value;
  }
  template <class Integer>
  [[nodiscard]] Integer integer(std::string_view column) const {
    const auto value = parse_integer<Integer>(text(column));
    if (!value) fail(column, "a whole number");
    return *value;
  }
  [[noreturn]] void fail(std::string_view column, const std::string& must_be) const {
    throw InputError(
        where_, std::string(column) + " is '" + std::string(text(column)) + "', must be " + must_be,
        "correct or remove the line");
  }

 private:
  std::vector<std::string_view> fields_;
  const ColumnPlaces& places_;
  std::string where_;
};

RelativePose parse_pose(const Fields& fields) {
  const Eigen::Quaterniond q(fields.real("qw"), fields.real("qx"), fields.real("qy"),
                             fields.real("qz"));
  if (!(std::abs(q.norm() - 1.0) < kUnitTolerance)) {
    fields.fail("qw", "the first entry of a unit quaternion qw,qx,qy,qz");
  }
  return {q.normalized().toRotationMatrix(),
          {fields.real("tx"), fields.real("ty"), fields.real("tz")}};
}

bool parse_flag(const Fields& fields, std::string_view column) {
  const auto text = fields.text(column);
  if (text != "0" && text != "1") fields.fail(column, "0 or 1");
  return text == "1";
}

std::optional<double> parse_sigma(const Fields& fields) {
  constexpr std::string_view kColumn = "sigma_length";
  if (fields.text(kColumn).empty()) return std::nullopt;
  const double sigma = fields.real(kColumn);
  if (sigma < 0.0) fields.fail(kColumn, "empty or at least 0");
  return sigma;
}

RelativePoseRow parse_row(const Fields& fields) {
  RelativePoseRow row;
  row.index1 = fields.integer<std::size_t>("index1");
  row.index2 = fields.integer<std::size_t>("index2");
  row.t1 = fields.real("t1");
  row.t2 = fields.real("t2");
  row.T_2_1 = parse_pose(fields);
  row.metric = parse_flag(fields, "metric");
  row.inliers = fields.integer<int>("inliers");
  row.acs = fields.integer<int>("acs");
  row.status = std::string(fields.text("status"));
  if (row.status.find('\r') != std::string::npos) fields.fail("status", "without a line break");
  row.sigma_length = parse_sigma(fields);
  return row;
}

void require_writable(const RelativePoseRow& row) {
  const std::string where = "RelativePoseRow of images " + std::to_string(row.index1) + " and " +
                            std::to_string(row.index2);
  if (!row.T_2_1.is_finite() || !std::isfinite(row.t1) || !std::isfinite(row.t2)) {
    throw std::invalid_argument(where + ": T_2_1, t1 and t2 must be finite");
  }
  const double sigma = row.sigma_length.value_or(0.0);
  if (!std::isfinite(sigma) || sigma < 0.0) {
    throw std::invalid_argument(where + ": sigma_length must be finite and at least 0");
  }
  if (row.status.find_first_of(",\r\n") != std::string::npos) {
    throw std::invalid_argument(where + ": status must not have a comma or a line break");
  }
}

}  // namespace

std::vector<RelativePoseRow> read_relative_poses(const std::filesystem::path& path) {
  const std::string text = read_text(path);
  const auto lines = data_lines(text);
  if (lines.empty()) throw InputError(path.string(), "is blank", "write or copy it again");
  const ColumnPlaces places = find_columns(lines.front(), path.string());
  std::vector<RelativePoseRow> rows;
  for (std::size_t k = 1; k < lines.size(); ++k) {
    rows.push_back(parse_row(Fields(lines[k], places, path.string())));
  }
  return rows;
}

bool looks_like_relative_poses(const std::filesystem::path& path) {
  if (!fault_of_file(path).empty()) return false;
  std::ifstream stream(path);
  std::string line;
  if (!std::getline(stream, line)) return false;
  const auto names = split_at_commas(line);
  return std::find(names.begin(), names.end(), kColumns.front()) != names.end();
}

std::string relative_poses_header() {
  return header() + '\n';
}

std::string relative_pose_line(const RelativePoseRow& row) {
  require_writable(row);
  Eigen::Quaterniond q(row.T_2_1.R);
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  const Eigen::Vector3d& t = row.T_2_1.t;
  std::string line = std::to_string(row.index1) + ',' + std::to_string(row.index2) + ',' +
                     exact_fixed_text(row.t1, kTimeDecimals) + ',' +
                     exact_fixed_text(row.t2, kTimeDecimals);
  for (double v : {q.w(), q.x(), q.y(), q.z(), t.x(), t.y(), t.z()}) line += ',' + exact_text(v);
  return line + (row.metric ? ",1," : ",0,") + std::to_string(row.inliers) + ',' +
         std::to_string(row.acs) + ',' + row.status + ',' +
         (row.sigma_length ? exact_text(*row.sigma_length) : "") + '\n';
}

std::string format_relative_poses(const std::vector<RelativePoseRow>& rows) {
  std::string text = relative_poses_header();
  for (const RelativePoseRow& row : rows) text += relative_pose_line(row);
  return text;
}

std::string timings_header() {
  return "index1,index2,ms_decode,ms_features,ms_estimate,ms_refine\n";
}

std::string timing_line(const TimingRow& row) {
  constexpr int kDecimals = 3;  // microseconds; thread clocks are no finer in practice
  std::string line = std::to_string(row.index1) + ',' + std::to_string(row.index2);
  for (double ms : {row.decode_ms, row.features_ms, row.estimate_ms, row.refine_ms}) {
    if (!std::isfinite(ms)) throw std::invalid_argument("TimingRow: times must be finite");
    line += ',' + fixed_text(ms, kDecimals);
  }
  return line + '\n';
}

std::string format_timings(const std::vector<TimingRow>& rows) {
  std::string text = timings_header();
  for (const TimingRow& row : rows) text += timing_line(row);
  return text;
}

}  // namespace oneac
