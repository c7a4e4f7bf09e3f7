#include "import/exif_times.h"

#include "import/stamps.h"

#include <libexif/exif-data.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <memory>
#include <string_view>

namespace oneac {
namespace {

namespace fs = std::filesystem;

struct Unref {
  void operator()(ExifData* data) const { exif_data_unref(data); }
};
using Exif = std::unique_ptr<ExifData, Unref>;

/// Text of a tag of the image's own directory, without what fills it up.
std::string text_of(const Exif& exif, ExifTag tag) {
  const ExifEntry* entry = exif_content_get_entry(exif->ifd[EXIF_IFD_EXIF], tag);
  if (entry == nullptr || entry->format != EXIF_FORMAT_ASCII || entry->data == nullptr) return "";
  std::string text(reinterpret_cast<const char*>(entry->data), entry->size);
  text.resize(std::min(text.find('\0'), text.size()));
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

/// "2024:05:01 10:00:00" as Unix time, taken for UTC.
std::optional<double> seconds_of(std::string date) {
  constexpr std::size_t kLength = 19;
  if (date.size() != kLength || date[4] != ':' || date[7] != ':') return std::nullopt;
  date[4] = date[7] = '-';
  return date_stamp(date);
}

/// "042" are 42 milliseconds. Empty where it is no fraction.
std::optional<double> fraction_of(const std::string& digits) {
  const bool all = !digits.empty() && digits.size() <= 9 &&
                   std::all_of(digits.begin(), digits.end(),
                               [](unsigned char c) { return std::isdigit(c) != 0; });
  if (!all) return std::nullopt;
  double value = 0.0;
  const std::string text = "0." + digits;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

/// "+02:00" are 7200 seconds.
std::optional<double> offset_of(const std::string& zone) {
  if (zone.size() != 6 || (zone[0] != '+' && zone[0] != '-') || zone[3] != ':') return std::nullopt;
  int hours = 0, minutes = 0;
  const auto h = std::from_chars(zone.data() + 1, zone.data() + 3, hours);
  const auto m = std::from_chars(zone.data() + 4, zone.data() + 6, minutes);
  const bool sound = h.ptr == zone.data() + 3 && m.ptr == zone.data() + 6 && hours <= 14;
  if (!sound || minutes >= 60) return std::nullopt;
  const double seconds = 3600.0 * hours + 60.0 * minutes;
  return zone[0] == '-' ? -seconds : seconds;
}

/// 1 to 8; 1 is as stored, and where nothing is told.
int orientation_of(const fs::path& image) {
  const Exif exif(exif_data_new_from_file(image.c_str()));
  if (!exif) return 1;
  const ExifEntry* entry = exif_content_get_entry(exif->ifd[EXIF_IFD_0], EXIF_TAG_ORIENTATION);
  if (entry == nullptr || entry->format != EXIF_FORMAT_SHORT || entry->size < 2) return 1;
  const int told = exif_get_short(entry->data, exif_data_get_byte_order(exif.get()));
  return told >= 1 && told <= 8 ? told : 1;
}

/// Of all images; empty, and the first without, when one has none.
std::vector<ExifTime> all_times(const std::vector<fs::path>& images, fs::path& without) {
  std::vector<ExifTime> times;
  for (const fs::path& image : images) {
    const auto time = exif_time(image);
    if (!time) {
      without = image;
      return {};
    }
    times.push_back(*time);
  }
  return times;
}

/// What is said of the zones in the note on EXIF times.
std::string zone_note(const std::vector<ExifTime>& times) {
  const auto telling = static_cast<std::size_t>(std::count_if(
      times.begin(), times.end(), [](const ExifTime& time) { return time.zone_s.has_value(); }));
  if (telling == times.size()) return "";
  if (telling == 0) return ", whose time zone is not told: taken for UTC";
  return "; " + std::to_string(times.size() - telling) + " of " + std::to_string(times.size()) +
         " tell no time zone: that of the others is taken";
}

/// In UTC.
std::vector<double> unix_times(const std::vector<ExifTime>& times) {
  const auto telling = std::find_if(times.begin(), times.end(),
                                    [](const ExifTime& time) { return time.zone_s.has_value(); });
  double zone_s = telling == times.end() ? 0.0 : *telling->zone_s;
  std::vector<double> all;
  for (const ExifTime& time : times) {
    zone_s = time.zone_s.value_or(zone_s);
    all.push_back(time.local_s - zone_s);
  }
  return all;
}

/// The last number in a name; "" without one.
std::string counter_of(const fs::path& image) {
  const std::string stem = image.stem().string();
  const auto end = stem.find_last_of("0123456789");
  if (end == std::string::npos) return "";
  const auto before = stem.find_last_not_of("0123456789", end);
  return stem.substr(before == std::string::npos ? 0 : before + 1, end - before);
}

/// Whether a counter of the camera can have begun anew: names up to all nines, and from 0 or 1 on.
/// Times alone do not tell: a clock set back halfway gives the same.
bool may_have_rolled_over(const std::vector<fs::path>& images) {
  constexpr std::size_t kFewestDigits = 3;
  if (images.size() < 2) return false;
  const std::string first = counter_of(images.front()), last = counter_of(images.back());
  return last.size() >= kFewestDigits && first.size() == last.size() &&
         last.find_first_not_of('9') == std::string::npos &&
         first.find_first_not_of('0') >= first.size() - 1 && first.back() <= '1';
}

}  // namespace

std::optional<ExifTime> exif_time(const fs::path& image) {
  const Exif exif(exif_data_new_from_file(image.c_str()));
  if (!exif) return std::nullopt;
  const auto seconds = seconds_of(text_of(exif, EXIF_TAG_DATE_TIME_ORIGINAL));
  if (!seconds) return std::nullopt;
  const auto fraction = fraction_of(text_of(exif, EXIF_TAG_SUB_SEC_TIME_ORIGINAL));
  const auto offset = offset_of(text_of(exif, EXIF_TAG_OFFSET_TIME_ORIGINAL));
  return ExifTime{*seconds + fraction.value_or(0.0), fraction.has_value(), offset};
}

std::vector<double> stamps_from_exif(const std::vector<fs::path>& images, ImportReport& report,
                                     std::string& fault) {
  fs::path without;
  const std::vector<ExifTime> told = all_times(images, without);
  if (told.empty()) {
    fault = "no EXIF time of " + without.filename().string();
    return {};
  }
  std::vector<double> times = unix_times(told);
  bool fractions = told.front().has_fraction;
  for (std::size_t i = 1; i < times.size(); ++i) {
    fractions = fractions && told[i].has_fraction;
    if (times[i] > times[i - 1]) continue;
    fault = std::string(fractions ? "an" : "a whole second only as") + " EXIF time of " +
            images[i].filename().string() + " that is not later than the one before";
    return {};
  }
  report.notes.push_back("the images are stamped with their EXIF times" + zone_note(told));
  return times;
}

void unroll_counter(std::vector<fs::path>& images, ImportReport& report) {
  if (!may_have_rolled_over(images)) return;
  fs::path without;
  const std::vector<double> times = unix_times(all_times(images, without));
  const auto earlier = [](double a, double b) { return b < a; };
  const auto step = std::adjacent_find(times.begin(), times.end(), earlier);
  const bool one_step = step != times.end() && times.back() <= times.front() &&
                        std::adjacent_find(step + 1, times.end(), earlier) == times.end();
  if (!one_step) return;
  const auto second = images.begin() + (step + 1 - times.begin());
  std::rotate(images.begin(), second, images.end());
  report.notes.push_back(
      "the camera's counter has begun anew: by their EXIF times the images go "
      "from " +
      images.front().filename().string() + " to " + images.back().filename().string());
}

void note_orientation(const std::vector<fs::path>& images, ImportReport& report) {
  std::size_t turned = 0;
  int first = 1;
  for (const fs::path& image : images) {
    const int told = orientation_of(image);
    if (told == 1) continue;
    if (turned++ == 0) first = told;
  }
  if (turned == 0) return;
  report.notes.push_back(std::to_string(turned) + " of " + std::to_string(images.size()) +
                         " images tell an EXIF Orientation (" + std::to_string(first) +
                         "): they are taken as they are stored, and the calibration has to be "
                         "that of such images");
}

}  // namespace oneac
