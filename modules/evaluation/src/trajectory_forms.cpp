#include "pose_rows.h"
#include "text_io.h"

#include "oneac/base/error.h"
#include "oneac/base/finite_number.h"
#include "oneac/base/number_text.h"
#include "oneac/evaluation/statistics.h"
#include "oneac/evaluation/trajectory_io.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace oneac {
namespace {

/// What the columns of a line mean.
enum class Form {
  kMatrix,       ///< 12: KITTI
  kTum,          ///< 8: time, position, qx qy qz qw
  kSquare,       ///< 16: the same matrix with its last row
  kTimedMatrix,  ///< 13: time, KITTI
  kTimedSquare,  ///< 17: time, 16 numbers
  kCommas,       ///< 8 and more behind commas, by Columns
  kBlock         ///< 4: a row of a matrix of four lines
};

constexpr double kMicrosecond = 1e-6;
constexpr double kTimeBound = 1e19;  // nanoseconds since 1970 have 1.8e18

std::optional<double> parse_time(std::string_view field) {
  const auto value = finite_number(field);
  return value && std::abs(*value) < kTimeBound ? value : std::nullopt;
}

bool has_commas(std::string_view line) {
  return line.find(',') != std::string_view::npos;
}

std::vector<std::string_view> fields_of(std::string_view line) {
  return has_commas(line) ? split_at_commas(line) : split_at_blanks(line);
}

/// Where a comma-separated line has time, x, y, z, qw, qx, qy, qz.
using Columns = std::array<std::size_t, 8>;
constexpr Columns kInOrder{0, 1, 2, 3, 4, 5, 6, 7};

/// Of a column's name such as "q_RS_w []", "p_RS_R_x [m]", "qw", "tx" or "#timestamp [ns]": its
/// place in Columns.
std::optional<std::size_t> role_of(std::string_view named) {
  std::string name(named.substr(0, named.find_first_of("[(")));
  name.erase(std::remove_if(name.begin(), name.end(),
                            [](unsigned char c) { return std::isalnum(c) == 0; }),
             name.end());
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (name.empty()) return std::nullopt;
  if (name == "t" || name.find("time") != std::string::npos ||
      name.find("stamp") != std::string::npos) {
    return 0;
  }
  constexpr std::string_view kAxes = "wxyz";
  const std::size_t axis = kAxes.find(name.back());
  if (axis == std::string_view::npos) return std::nullopt;
  const char kind = name.front();
  if (kind == 'q' || kind == 'o') return 4 + axis;  // q…, orientation
  const bool place = name.size() == 1 || kind == 'p' || kind == 't';
  if (!place || axis == 0) return std::nullopt;  // a velocity, a bias
  return axis;
}

/// As the line of names before the first of numbers tells; none without.
/// @throws InputError where it names a pose in part
std::optional<Columns> named_columns(std::string_view text, std::string_view first,
                                     const std::string& file) {
  std::string_view head = text.substr(0, text.find(first));
  while (!head.empty() && (head.back() == '\n' || head.back() == '\r')) head.remove_suffix(1);
  const std::string_view line = head.substr(head.rfind('\n') + 1);
  Columns columns{};
  std::array<bool, 8> told{};
  std::size_t place = 0;
  for (const std::string_view name : split_at_commas(line)) {
    if (const auto role = role_of(name); role && !told.at(*role)) {
      columns.at(*role) = place;
      told.at(*role) = true;
    }
    ++place;
  }
  if (std::all_of(told.begin(), told.end(), [](bool t) { return t; })) return columns;
  if (std::none_of(told.begin() + 1, told.end(), [](bool t) { return t; })) return std::nullopt;
  constexpr std::array<const char*, 8> kNames{"time", "x", "y", "z", "qw", "qx", "qy", "qz"};
  const auto missing =
      static_cast<std::size_t>(std::find(told.begin(), told.end(), false) - told.begin());
  throw InputError(file, std::string("its first line names columns, but no ") + kNames.at(missing),
                   "name time, x, y, z, qw, qx, qy and qz");
}

std::optional<Form> form_of(std::string_view first) {
  const std::size_t columns = fields_of(first).size();
  if (has_commas(first)) return columns < 8 ? std::nullopt : std::optional(Form::kCommas);
  switch (columns) {
    case 4:
      return Form::kBlock;
    case 8:
      return Form::kTum;
    case 12:
      return Form::kMatrix;
    case 13:
      return Form::kTimedMatrix;
    case 16:
      return Form::kSquare;
    case 17:
      return Form::kTimedSquare;
    default:
      return std::nullopt;
  }
}

bool is_timed(Form form) {
  return form != Form::kMatrix && form != Form::kSquare && form != Form::kBlock;
}

/// A line of numbers; the time, where there is one, apart.
struct Row {
  double time = 0.0;
  std::vector<double> numbers;
  std::string where;
};

[[noreturn]] void bad_number(const std::string& where, std::size_t column, std::string_view field) {
  throw InputError(where,
                   "column " + std::to_string(column) + " is '" + std::string(field) +
                       "', not a finite number below 1e15",
                   "remove the line or write the file again");
}

/// Behind commas only the pose is read: what stands beside it may be anything.
std::vector<std::size_t> places_of(Form form, const Columns& columns, std::size_t fields) {
  if (form == Form::kCommas) return {columns.begin(), columns.end()};
  std::vector<std::size_t> all(fields);
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

Row row_of(const TextLine& line, const std::string& file, Form form, const Columns& columns) {
  Row row;
  row.where = where_in(file, line.number);
  const auto fields = fields_of(line.text);
  for (const std::size_t i : places_of(form, columns, fields.size())) {
    if (i >= fields.size()) break;
    const bool is_time = is_timed(form) && row.numbers.empty() && i == columns.front();
    const auto value = is_time ? parse_time(fields[i]) : parse_finite(fields[i]);
    if (!value) bad_number(row.where, i + 1, fields[i]);
    if (is_time) {
      row.time = *value;
    } else {
      row.numbers.push_back(*value);
    }
  }
  return row;
}

Eigen::Isometry3d pose_of(const Row& row, Form form) {
  const std::vector<double>& v = row.numbers;
  if (form == Form::kCommas) {
    return internal::pose_of_quaternion({v[0], v[1], v[2], v[4], v[5], v[6], v[3]}, row.where);
  }
  if (form == Form::kTum) {
    return internal::pose_of_quaternion({v[0], v[1], v[2], v[3], v[4], v[5], v[6]}, row.where);
  }
  if (v.size() == 16 && !(v[12] == 0.0 && v[13] == 0.0 && v[14] == 0.0 && v[15] == 1.0)) {
    throw InputError(row.where, "the last row of the matrix is not 0 0 0 1",
                     "write T_world_body row by row");
  }
  std::array<double, 12> upper{};
  std::copy_n(v.begin(), upper.size(), upper.begin());
  return internal::pose_of_matrix(upper, row.where);
}

/// Four lines become one.
std::vector<Row> joined_blocks(const std::vector<Row>& rows, const std::string& file) {
  if (rows.size() % 4 != 0) {
    throw InputError(file, std::to_string(rows.size()) + " lines of 4 columns are no 4x4 matrices",
                     "write four lines per pose");
  }
  std::vector<Row> joined;
  for (std::size_t i = 0; i < rows.size(); i += 4) {
    joined.push_back(rows[i]);
    for (std::size_t k = i + 1; k < i + 4; ++k) {
      joined.back().numbers.insert(joined.back().numbers.end(), rows[k].numbers.begin(),
                                   rows[k].numbers.end());
    }
  }
  return joined;
}

std::vector<Row> rows_of(const std::vector<TextLine>& lines, const std::string& file, Form form,
                         const Columns& columns) {
  std::vector<Row> rows;
  for (const TextLine& line : lines) {
    rows.push_back(row_of(line, file, form, columns));
    if (rows.back().numbers.size() == rows.front().numbers.size()) continue;
    throw InputError(rows.back().where,
                     std::to_string(fields_of(line.text).size()) + " columns, must be " +
                         std::to_string(fields_of(lines.front().text).size()),
                     "write every pose in the same form");
  }
  return form == Form::kBlock ? joined_blocks(rows, file) : rows;
}

struct TimeUnit {
  const char* name;
  double seconds;
};
constexpr std::array<TimeUnit, 4> kUnits{
    {{"seconds", 1.0}, {"milliseconds", 1e-3}, {"microseconds", 1e-6}, {"nanoseconds", 1e-9}}};

/// By their size when they count from 1970 (the years 1973 to 5138), else by their spacing: poses
/// are 4 ms to 4 s apart, and closer ones are told in seconds.
TimeUnit unit_of(const std::vector<Row>& rows) {
  constexpr double kEarliest_s = 1e8, kLatest_s = 1e11, kWidest_s = 4.0;
  const double first = std::abs(rows.front().time);
  if (first >= kEarliest_s) {
    for (const TimeUnit& unit : kUnits) {
      if (first * unit.seconds < kLatest_s) return unit;
    }
  }
  std::vector<double> spacings;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    spacings.push_back(std::abs(rows[i].time - rows[i - 1].time));
  }
  if (spacings.empty()) return kUnits.front();
  const double spacing = percentile(std::move(spacings), 50.0);
  for (const TimeUnit& unit : kUnits) {
    if (spacing * unit.seconds < kWidest_s) return unit;
  }
  return kUnits.front();
}

/// In order of time, each time once: of several rows with one stamp the first.
void put_in_order(std::vector<Row>& rows, const std::string& file,
                  std::vector<std::string>& notes) {
  const auto earlier = [](const Row& a, const Row& b) { return a.time < b.time; };
  if (!std::is_sorted(rows.begin(), rows.end(), earlier)) {
    notes.push_back(file + " is not in order of time and was sorted");
    std::stable_sort(rows.begin(), rows.end(), earlier);
  }
  const std::size_t before = rows.size();
  rows.erase(std::unique(rows.begin(), rows.end(),
                         [](const Row& a, const Row& b) { return !(a.time < b.time); }),
             rows.end());
  if (rows.size() == before) return;
  notes.push_back(file + " has " + std::to_string(before - rows.size()) +
                  " rows with the stamp of another one: the first of each was taken");
}

/// A file that is called .tum or .kitti is one.
void require_named_form(const std::filesystem::path& path, Form form, const TextLine& first) {
  const std::string name = path.extension().string();
  const bool misnamed =
      (name == ".tum" && form != Form::kTum) || (name == ".kitti" && form != Form::kMatrix);
  if (!misnamed) return;
  throw InputError(where_in(path.string(), first.number),
                   std::to_string(fields_of(first.text).size()) + " columns" +
                       (has_commas(first.text) ? " behind commas" : "") + ", must be " +
                       (name == ".tum" ? "8 behind blanks" : "12"),
                   "call a trajectory of another form .txt or .csv");
}

/// A first line of names.
void drop_names(std::vector<TextLine>& lines) {
  const auto first = static_cast<unsigned char>(lines.front().text.front());
  if (lines.size() > 1 && std::isalpha(first) != 0 && has_commas(lines.front().text)) {
    lines.erase(lines.begin());
  }
}

/// EuRoC counts nanoseconds; who writes others with commas between has TUM's columns, qw last.
void read_as_usual(std::vector<Row>& rows, const std::string& file,
                   std::vector<std::string>& notes) {
  const bool euroc = unit_of(rows).seconds < kMicrosecond;
  notes.push_back(file + " names no columns and is read as t, x, y, z, " +
                  (euroc ? "qw, qx, qy, qz" : "qx, qy, qz, qw"));
  if (euroc) return;
  for (Row& row : rows) {
    std::rotate(row.numbers.begin() + 3, row.numbers.end() - 1, row.numbers.end());
  }
}

}  // namespace

TrajectoryFile read_trajectory_file(const std::filesystem::path& path) {
  const std::string file = path.string(), text = read_text(path);
  auto lines = data_lines(text);
  if (lines.empty()) throw InputError(file, "has no poses", "write or copy it again");
  drop_names(lines);
  const std::string_view first = lines.front().text;
  const auto form = form_of(first);
  if (!form) {
    throw InputError(
        where_in(file, lines.front().number),
        std::to_string(fields_of(first).size()) +
            " columns, must be 12 (KITTI) or 8 (TUM), or those of EuRoC or 4x4 matrices",
        "name a trajectory in one of these formats");
  }
  require_named_form(path, *form, lines.front());
  TrajectoryFile result;
  const bool commas = *form == Form::kCommas;
  const auto named = commas ? named_columns(text, first, file) : std::nullopt;
  std::vector<Row> rows = rows_of(lines, file, *form, named.value_or(kInOrder));
  if (commas && !named) read_as_usual(rows, file, result.notes);
  if (is_timed(*form)) {
    const TimeUnit unit = unit_of(rows);
    if (unit.seconds < 1.0) result.notes.push_back(file + " is stamped in " + unit.name);
    put_in_order(rows, file, result.notes);
    for (const Row& row : rows) result.trajectory.times.push_back(row.time * unit.seconds);
  }
  for (const Row& row : rows) result.trajectory.poses.push_back(pose_of(row, *form));
  return result;
}

Trajectory read_trajectory(const std::filesystem::path& path) {
  if (path.extension() == ".kitti") return read_kitti(path);
  return read_trajectory_file(path).trajectory;
}

}  // namespace oneac
