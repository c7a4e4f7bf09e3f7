#include "import/stamps.h"

#include "import/number_table.h"

#include "oneac/base/error.h"
#include "oneac/base/input_file.h"
#include "oneac/base/median.h"
#include "oneac/base/number_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <fstream>
#include <optional>
#include <string_view>
#include <utility>

namespace oneac {
namespace {

/// "Z", "+02:00", "-0330", "+02" or nothing, at the end of a time: seconds east of Greenwich.
std::optional<double> zone_of(std::string_view text) {
  if (text.empty() || text == "Z") return 0.0;
  const bool colon = text.size() == 6 && text[3] == ':';
  if ((text[0] != '+' && text[0] != '-') || (!colon && text.size() != 5 && text.size() != 3)) {
    return std::nullopt;
  }
  const auto two = [text](std::size_t at) {
    int value = 0;
    const char* begin = text.data() + at;
    const auto result = std::from_chars(begin, begin + 2, value);
    return result.ec == std::errc() && result.ptr == begin + 2 && value >= 0 ? value : 99;
  };
  const int hours = two(1), minutes = text.size() == 3 ? 0 : two(colon ? 4 : 3);
  if (hours > 14 || minutes > 59) return std::nullopt;
  const double seconds = 3600.0 * hours + 60.0 * minutes;
  return text[0] == '-' ? -seconds : seconds;
}

namespace fs = std::filesystem;

constexpr double kUnixTimes_s = 1e8;  // tables count from 0; larger ones are Unix times

std::optional<std::size_t> number_of(const fs::path& image) {
  const std::string stem = image.stem().string();
  std::size_t number = 0;
  const auto result = std::from_chars(stem.data(), stem.data() + stem.size(), number);
  const bool all = result.ec == std::errc() && result.ptr == stem.data() + stem.size();
  return all ? std::optional(number) : std::nullopt;
}

struct TimeUnit {
  const char* name;
  double seconds;
};
// Steps of a thousand, and spacings of images that differ by less: one unit fits at most.
constexpr std::array<TimeUnit, 4> kUnits{
    {{"seconds", 1.0}, {"milliseconds", 1e-3}, {"microseconds", 1e-6}, {"nanoseconds", 1e-9}}};
constexpr double kClosest_s = 0.004, kWidest_s = 2.0;  // 250 Hz, an image in two seconds
constexpr double kLatest_s = 4.1e9;                    // the year 2100

constexpr const char* kTimesCure =
    "give seconds, or ms, us or ns of a drive with an image every 4 ms to 2 s, or take the file "
    "away for 10 Hz";

constexpr const char* kSequenceCure =
    "give the times.txt of this sequence, or take it away for 10 Hz";

/// Two numbers in each row of times are most likely one with a comma in it.
std::string times_cure(const std::vector<std::vector<double>>& table, const char* otherwise) {
  if (table.front().size() != 2) return otherwise;
  return std::string("write a decimal point where the numbers have a comma, or ") + otherwise;
}

/// The unit that makes the median spacing one of images; seconds for a single row.
TimeUnit unit_by_spacing(const std::vector<std::vector<double>>& table, const fs::path& file) {
  std::vector<double> spacings;
  for (std::size_t i = 1; i < table.size(); ++i) {
    spacings.push_back(std::abs(table[i][0] - table[i - 1][0]));
  }
  if (spacings.empty()) return kUnits[0];
  const double median = upper_median(std::move(spacings));
  for (const TimeUnit& unit : kUnits) {
    const double spacing = unit.seconds * median;
    if (spacing >= kClosest_s && spacing <= kWidest_s) return unit;
  }
  throw InputError(file.string(),
                   "rows are " + exact_text(median) +
                       " apart, which is no spacing of images in s, "
                       "ms, us or ns",
                   times_cure(table, kTimesCure));
}

/// @throws InputError naming the row of a time that is none since 1970 or the start
TimeUnit unit_of(const std::vector<std::vector<double>>& table, const fs::path& file) {
  const TimeUnit unit = unit_by_spacing(table, file);
  for (std::size_t row = 0; row < table.size(); ++row) {
    const double time_s = unit.seconds * table[row][0];
    if (time_s >= 0.0 && time_s <= kLatest_s) continue;
    throw InputError(
        file.string() + ": row " + std::to_string(row + 1),
        exact_text(table[row][0]) + " " + unit.name + " is no time since the start or 1970",
        kTimesCure);
  }
  return unit;
}

/// The last number of a name, with its decimal point where it has one.
std::string last_number(const std::string& stem) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  std::size_t end = stem.size();
  while (end > 0 && !is_digit(stem[end - 1])) --end;
  std::size_t begin = end;
  bool point = false;
  while (begin > 0) {
    const char c = stem[begin - 1];
    const bool is_point = c == '.' && !point && begin > 1 && is_digit(stem[begin - 2]);
    if (!is_digit(c) && !is_point) break;
    point = point || is_point;
    --begin;
  }
  return stem.substr(begin, end - begin);
}

/// The whole number in front of a decimal point and the part behind it.
std::optional<std::pair<std::int64_t, double>> split_number(const std::string& digits) {
  std::int64_t whole = 0;
  const char* end = digits.data() + digits.size();
  const auto result = std::from_chars(digits.data(), end, whole);
  if (result.ec != std::errc() || whole < 0) return std::nullopt;
  double part = 0.0;
  if (result.ptr != end) {
    const auto behind = std::from_chars(result.ptr, end, part);
    if (*result.ptr != '.' || behind.ec != std::errc() || behind.ptr != end) return std::nullopt;
  }
  return std::pair(whole, part);
}

/// Of a month, 1 to 12.
int days_of(int year, int month) {
  constexpr std::array<int, 12> kDays{31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  const bool leap = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
  return kDays.at(static_cast<std::size_t>(month - 1)) + (leap && month == 2 ? 1 : 0);
}

}  // namespace

std::vector<std::size_t> rows_of(const std::vector<fs::path>& images, std::size_t rows) {
  std::vector<std::size_t> chosen;
  for (const fs::path& image : images) {
    const auto number = number_of(image);
    if (number && *number < rows) chosen.push_back(*number);
  }
  if (chosen.size() == images.size()) return chosen;
  chosen.clear();
  if (images.size() != rows) return chosen;
  for (std::size_t i = 0; i < rows; ++i) chosen.push_back(i);
  return chosen;
}

std::string counts(std::size_t rows, std::size_t images) {
  return std::to_string(rows) + " rows for " + std::to_string(images) + " images";
}

std::vector<double> stamps_from_table(const fs::path& file, const std::vector<fs::path>& images,
                                      ImportReport& report) {
  std::vector<double> times;
  const auto table = read_number_table(file, 1);
  const auto rows = rows_of(images, table.size());
  if (rows.empty()) {
    throw InputError(file.string(), counts(table.size(), images.size()), kSequenceCure);
  }
  const TimeUnit unit = unit_of(table, file);
  if (unit.seconds != 1.0) report.notes.push_back(std::string("times.txt is in ") + unit.name);
  const double epoch = unit.seconds * table.front()[0] < kUnixTimes_s ? kImportEpoch_s : 0.0;
  for (const std::size_t row : rows) {
    times.push_back(epoch + unit.seconds * table[row][0]);
    if (times.size() < 2 || times.back() > times[times.size() - 2]) continue;
    throw InputError(file.string() + ": row " + std::to_string(row + 1), "time does not increase",
                     times_cure(table, kSequenceCure));
  }
  return times;
}

std::vector<double> stamps_at_rate(std::size_t images, double rate_hz) {
  std::vector<double> times;
  for (std::size_t i = 0; i < images; ++i) {
    times.push_back(kImportEpoch_s + static_cast<double>(i) / rate_hz);
  }
  return times;
}

double seconds_since_1970(const std::string& digits) {
  constexpr double kEarliest_s = 9.4e8;  // the year 2000
  const auto number = split_number(digits);
  if (!number) return -1.0;
  for (const TimeUnit& unit : kUnits) {
    const double time_s = (static_cast<double>(number->first) + number->second) * unit.seconds;
    if (time_s < kEarliest_s || time_s > kLatest_s) continue;
    const auto per_second = static_cast<std::int64_t>(std::llround(1.0 / unit.seconds));
    const std::int64_t whole = number->first / per_second;  // a double has no room for 19 digits
    return static_cast<double>(whole) +
           (static_cast<double>(number->first % per_second) + number->second) * unit.seconds;
  }
  return -1.0;
}

std::vector<double> stamps_from_names(const std::vector<fs::path>& images) {
  std::vector<double> times;
  for (const fs::path& image : images) {
    const double time = seconds_since_1970(last_number(image.stem().string()));
    if (time < 0.0 || (!times.empty() && !(time > times.back()))) return {};
    times.push_back(time);
  }
  return times;
}

std::optional<double> date_stamp(const std::string& text) {
  std::array<int, 6> fields{};  // year, month, day, hour, minute, second
  constexpr std::string_view kBetween = "--T::";
  const char* at = text.data();
  const char* end = at + text.size();
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const auto result = std::from_chars(at, end, fields[i]);
    if (result.ec != std::errc()) return std::nullopt;
    at = result.ptr;
    if (i + 1 == fields.size()) break;
    const bool blank = kBetween[i] == 'T' && at != end && *at == ' ';
    if (at == end || (*at != kBetween[i] && !blank)) return std::nullopt;
    ++at;
  }
  double part = 0.0;
  if (at != end && *at == '.') {
    const auto result = std::from_chars(at, end, part);
    if (result.ec != std::errc()) return std::nullopt;
    at = result.ptr;
  }
  const auto zone = zone_of({at, static_cast<std::size_t>(end - at)});
  const bool sound =
      zone && fields[0] >= 1970 && fields[0] <= 2100 && fields[1] >= 1 && fields[1] <= 12 &&
      fields[2] >= 1 && fields[2] <= days_of(fields[0], fields[1]) && fields[3] >= 0 &&
      fields[3] < 24 && fields[4] >= 0 && fields[4] < 60 && fields[5] >= 0 && fields[5] <= 60;
  if (!sound) return std::nullopt;
  std::tm calendar{};
  calendar.tm_year = fields[0] - 1900;
  calendar.tm_mon = fields[1] - 1;
  calendar.tm_mday = fields[2];
  calendar.tm_hour = fields[3];
  calendar.tm_min = fields[4];
  calendar.tm_sec = fields[5];
  return static_cast<double>(timegm(&calendar)) + part - *zone;
}

bool names_zone(std::string_view date) {
  const auto clock = date.find_first_of("T ");
  return clock != std::string_view::npos && date.find_first_of("Z+-", clock) != date.npos;
}

std::vector<double> read_date_stamps(const fs::path& file) {
  std::ifstream stream = open_input(file, "put the file there");
  std::vector<double> times;
  std::size_t number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
    if (line.empty()) continue;
    const auto time = date_stamp(line);
    if (!time) {
      throw InputError(file.string() + ": line " + std::to_string(number),
                       "is no date and time such as 2011-09-26 13:02:25.594360375",
                       "get the file again from its source");
    }
    times.push_back(*time);
  }
  return times;
}

void require_increasing(const std::vector<double>& times, const std::vector<fs::path>& images,
                        const fs::path& file) {
  for (std::size_t i = 1; i < times.size(); ++i) {
    if (times[i] > times[i - 1]) continue;
    throw InputError(file.string() + ": image " + images[i].filename().string(),
                     "time does not increase", "give the times of these images in their order");
  }
}

}  // namespace oneac
