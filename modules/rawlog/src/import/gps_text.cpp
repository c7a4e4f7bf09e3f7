#include "import/gps_text.h"

#include "import/gps_order.h"
#include "import/stamps.h"

#include "oneac/base/error.h"
#include "oneac/base/finite_number.h"
#include "oneac/base/input_file.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace oneac {
namespace {

namespace fs = std::filesystem;

constexpr double kKnot = 1852.0 / 3600.0;  // [m/s]
constexpr double kKmh = 1.0 / 3.6;         // [m/s]

using Words = std::vector<std::string>;

/// Fields between separators, blanks around them and quotes taken away.
Words split(const std::string& line, char separator) {
  Words words;
  std::istringstream stream(line);
  for (std::string word; std::getline(stream, word, separator);) {
    const auto begin = word.find_first_not_of(" \t\r\"");
    const auto end = word.find_last_not_of(" \t\r\"");
    words.push_back(begin == std::string::npos ? "" : word.substr(begin, end - begin + 1));
  }
  return words;
}

/// A line that ends as on Unix, Windows or the Macs of old.
bool next_line(std::istream& stream, std::string& line) {
  line.clear();
  for (int c = stream.get(); c != EOF; c = stream.get()) {
    if (c == '\r' && stream.peek() == '\n') continue;
    if (c == '\n' || c == '\r') return true;
    line += static_cast<char>(c);
  }
  return !line.empty();
}

std::string at(const std::string& file, std::size_t line) {
  return file + ": line " + std::to_string(line);
}

/// Collects fixes.
class Fixes {
 public:
  Fixes(const fs::path& file, ImportReport& report) : file_(file), report_(report) {}

  /// @throws InputError for a position that is none
  void add(GpsRecord fix, std::size_t line) {
    const GeodeticPosition& p = fix.position;
    const bool on_earth = std::abs(p.latitude_deg) <= 90.0 && std::abs(p.longitude_deg) <= 180.0;
    if (!on_earth || std::isinf(p.altitude_m)) {
      throw InputError(at(file_.string(), line),
                       "latitude or longitude is beyond the range of degrees",
                       "give decimal degrees, north and east positive");
    }
    fix.label = "gps";
    fixes_.push_back(std::move(fix));
  }
  void pass_over() { ++passed_over_; }

  std::vector<GpsRecord> finish() {
    passed_over_ += put_in_order(fixes_);
    if (fixes_.empty()) {
      throw InputError(file_.string(), "it holds no position with a time",
                       "give the file that the receiver wrote during the drive");
    }
    if (passed_over_ > 0) {
      report_.notes.push_back(std::to_string(passed_over_) + " fixes of " +
                              file_.filename().string() +
                              " are void, damaged, at 0, 0, of another day or not later than the "
                              "one before");
    }
    fill_heights(fixes_);
    return std::move(fixes_);
  }

 private:
  const fs::path& file_;
  ImportReport& report_;
  std::vector<GpsRecord> fixes_;
  std::size_t passed_over_ = 0;
};

/// Whether "$GPRMC,…*5A" has the checksum that it says; one without is believed.
bool is_sound_sentence(const std::string& line) {
  const auto star = line.find('*');
  if (star == std::string::npos) return true;
  unsigned sum = 0;
  for (std::size_t i = 1; i < star; ++i) sum ^= static_cast<unsigned char>(line[i]);
  unsigned said = 0;
  const char* begin = line.data() + star + 1;
  const auto result = std::from_chars(begin, line.data() + line.size(), said, 16);
  return result.ec == std::errc() && result.ptr == begin + 2 && said == sum;
}

/// "4807.038", "N" in degrees.
std::optional<double> degrees(const std::string& text, const std::string& side) {
  constexpr double kMinutes = 60.0, kHundred = 100.0;
  const auto value = finite_number(text);
  if (!value || *value < 0.0 || side.size() != 1) return std::nullopt;
  const double whole = std::floor(*value / kHundred);
  const double angle = whole + (*value - kHundred * whole) / kMinutes;
  return side == "S" || side == "W" ? -angle : angle;
}

/// "123519.20", "230394": Unix time [s].
std::optional<double> nmea_time(const std::string& time, const std::string& date) {
  if (time.size() < 6 || date.size() != 6) return std::nullopt;
  const std::string text = "20" + date.substr(4, 2) + "-" + date.substr(2, 2) + "-" +
                           date.substr(0, 2) + "T" + time.substr(0, 2) + ":" + time.substr(2, 2) +
                           ":" + time.substr(4);
  return date_stamp(text);
}

/// Altitude and quality of a GGA, by its time of day.
struct GgaFields {
  double altitude_m = unknown_height();
  int quality = 1;
  int satellites = 0;
};

struct RmcLine {
  Words fields;
  std::size_t line;
};

/// Void and incomplete fixes give nothing.
std::optional<GpsRecord> fix_of(const Words& rmc, const std::map<std::string, GgaFields>& ggas) {
  constexpr std::size_t kFields = 10;  // up to the date
  if (rmc.size() < kFields || rmc[2] != "A") return std::nullopt;
  const auto time = nmea_time(rmc[1], rmc[9]);
  const auto latitude = degrees(rmc[3], rmc[4]), longitude = degrees(rmc[5], rmc[6]);
  if (!time || !latitude || !longitude) return std::nullopt;
  GpsRecord fix;
  fix.time_s = *time;
  fix.position = {*latitude, *longitude, unknown_height()};
  const auto knots = finite_number(rmc[7]), course = finite_number(rmc[8]);
  if (knots && course) fix.velocity = GroundVelocity{*knots * kKnot, *course};
  const auto gga = ggas.find(rmc[1]);
  if (gga == ggas.end()) return fix;
  fix.position.altitude_m = gga->second.altitude_m;
  fix.fix_quality = gga->second.quality;
  fix.satellites = gga->second.satellites;
  return fix;
}

void add_gga(const Words& fields, std::map<std::string, GgaFields>& ggas) {
  constexpr std::size_t kFields = 10;  // up to the altitude
  if (fields.size() < kFields) return;
  const auto quality = finite_number(fields[6]), satellites = finite_number(fields[7]);
  GgaFields gga;
  gga.altitude_m = finite_number(fields[9]).value_or(unknown_height());
  const auto small = [](double value) { return value >= 0.0 && value < 100.0; };
  if (quality && small(*quality)) gga.quality = static_cast<int>(*quality);
  if (satellites && small(*satellites)) gga.satellites = static_cast<int>(*satellites);
  ggas[fields[1]] = gga;
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// Which column holds what.
struct Columns {
  std::optional<std::size_t> time, latitude, longitude, altitude, speed, course;
  double speed_unit = 1.0;
  bool speed_without_unit = false;
};

Columns columns_of(const Words& names) {
  Columns columns;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string name = lower(names[i]);
    if (name == "time" || name == "timestamp" || name == "t") columns.time = i;
    if (name == "lat" || name == "latitude") columns.latitude = i;
    if (name == "lon" || name == "lng" || name == "longitude") columns.longitude = i;
    if (name == "ele" || name == "alt" || name == "altitude") columns.altitude = i;
    if (name == "course" || name == "heading" || name == "bearing") columns.course = i;
    if (name == "speed") columns.speed_without_unit = true;
    for (const auto& [unit_name, unit] : {std::pair("speed_mps", 1.0), std::pair("speed_kmh", kKmh),
                                          std::pair("speed_knots", kKnot)}) {
      if (name != unit_name) continue;
      columns.speed = i;
      columns.speed_unit = unit;
    }
  }
  return columns;
}

class CsvRow {
 public:
  CsvRow(const Words& words, std::string where) : words_(words), where_(std::move(where)) {}

  [[nodiscard]] const std::string& text(std::size_t column) const {
    static const std::string kNone;
    return column < words_.size() ? words_[column] : kNone;
  }
  [[nodiscard]] double value(std::size_t column, const char* name) const {
    if (const auto found = finite_number(text(column))) return *found;
    throw InputError(where_,
                     std::string(name) + " '" + text(column).substr(0, 40) + "' is no number",
                     "correct the line, or take it away");
  }
  [[nodiscard]] double time(std::size_t column) const {
    const double counted = seconds_since_1970(text(column));
    if (counted >= 0.0) return counted;
    if (const auto date = date_stamp(text(column))) return *date;
    throw InputError(where_, "time '" + text(column).substr(0, 40) + "' is none since 1970",
                     "give s, ms, us or ns since 1970, or 2024-05-01T10:00:00Z");
  }
  /// Of a date; what is counted since 1970 needs none.
  [[nodiscard]] bool lacks_zone(std::size_t column) const {
    return seconds_since_1970(text(column)) < 0.0 && !names_zone(text(column));
  }

 private:
  const Words& words_;
  std::string where_;
};

GpsRecord fix_of(const CsvRow& row, const Columns& columns) {
  GpsRecord fix;
  fix.time_s = row.time(*columns.time);
  fix.position.latitude_deg = row.value(*columns.latitude, "latitude");
  fix.position.longitude_deg = row.value(*columns.longitude, "longitude");
  fix.position.altitude_m = unknown_height();
  if (columns.altitude && !row.text(*columns.altitude).empty()) {
    fix.position.altitude_m = row.value(*columns.altitude, "altitude");
  }
  const bool moving = columns.speed && columns.course && !row.text(*columns.speed).empty() &&
                      !row.text(*columns.course).empty();
  if (moving) {
    fix.velocity = GroundVelocity{row.value(*columns.speed, "speed") * columns.speed_unit,
                                  row.value(*columns.course, "course")};
  }
  return fix;
}

}  // namespace

std::vector<GpsRecord> read_nmea(const fs::path& file, ImportReport& report) {
  std::ifstream stream = open_input(file, "check its name");
  Fixes fixes(file, report);
  std::map<std::string, GgaFields> ggas;
  std::vector<RmcLine> rmcs;
  std::size_t number_of_line = 0;
  for (std::string line; next_line(stream, line);) {
    ++number_of_line;
    const auto dollar = line.find('$');  // loggers put their own stamps in front
    if (dollar == std::string::npos || line.size() < dollar + 7) continue;
    const std::string sentence = line.substr(dollar);
    const std::string kind = sentence.substr(3, 3);
    if (kind != "RMC" && kind != "GGA") continue;
    if (!is_sound_sentence(sentence)) {
      fixes.pass_over();
      continue;
    }
    const Words fields = split(sentence.substr(0, sentence.find('*')), ',');
    if (kind == "GGA") add_gga(fields, ggas);
    if (kind == "RMC") rmcs.push_back({fields, number_of_line});
  }
  if (rmcs.empty()) {
    throw InputError(file.string(), "it has no RMC sentences, which tell the date",
                     "give an NMEA file with $..RMC, or a CSV or GPX file");
  }
  for (const RmcLine& rmc : rmcs) {
    if (auto fix = fix_of(rmc.fields, ggas)) {
      fixes.add(std::move(*fix), rmc.line);
    } else {
      fixes.pass_over();
    }
  }
  return fixes.finish();
}

void note_times_without_zone(std::size_t count, const fs::path& file, ImportReport& report) {
  if (count == 0) return;
  report.notes.push_back(std::to_string(count) + " times of " + file.filename().string() +
                         " name no zone (Z, +02:00) and are taken as UTC");
}

std::vector<GpsRecord> read_gps_csv(const fs::path& file, ImportReport& report) {
  std::ifstream stream = open_input(file, "check its name");
  std::string line;
  next_line(stream, line);
  drop_byte_order_mark(line);
  const char separator = line.find(';') != std::string::npos ? ';' : ',';
  const Columns columns = columns_of(split(line, separator));
  if (!columns.time || !columns.latitude || !columns.longitude) {
    throw InputError(at(file.string(), 1), "it names no columns time, lat and lon",
                     "put their names into the first line");
  }
  if (columns.speed_without_unit && !columns.speed) {
    report.notes.push_back("the speeds of " + file.filename().string() +
                           " are left out, their unit is not known: name the column speed_mps, "
                           "speed_kmh or speed_knots");
  }
  Fixes fixes(file, report);
  std::size_t without_zone = 0;
  for (std::size_t number_of_line = 2; next_line(stream, line); ++number_of_line) {
    const Words words = split(line, separator);
    const bool blank = std::all_of(words.begin(), words.end(),
                                   [](const std::string& word) { return word.empty(); });
    if (blank) continue;
    const CsvRow row(words, at(file.string(), number_of_line));
    fixes.add(fix_of(row, columns), number_of_line);
    without_zone += row.lacks_zone(*columns.time) ? 1 : 0;
  }
  note_times_without_zone(without_zone, file, report);
  return fixes.finish();
}

}  // namespace oneac
