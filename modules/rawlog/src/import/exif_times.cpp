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

}  // namespace

std::optional<ExifTime> exif_time(const fs::path& image) {
  const Exif exif(exif_data_new_from_file(image.c_str()));
  if (!exif) return std::nullopt;
  const auto seconds = seconds_of(text_of(exif, EXIF_TAG_DATE_TIME_ORIGINAL));
  if (!seconds) return std::nullopt;
  const auto fraction = fraction_of(text_of(exif, EXIF_TAG_SUB_SEC_TIME_ORIGINAL));
  const auto offset = offset_of(text_of(exif, EXIF_TAG_OFFSET_TIME_ORIGINAL));
  return ExifTime{*seconds + fraction.value_or(0.0) - offset.value_or(0.0), fraction.has_value(),
                  offset.has_value()};
}

std::vector<double> stamps_from_exif(const std::vector<fs::path>& images, ImportReport& report,
                                     std::string& fault) {
  std::vector<double> times;
  bool zones = true, fractions = true;
  for (const fs::path& image : images) {
    const auto time = exif_time(image);
    if (!time) {
      fault = "no EXIF time of " + image.filename().string();
      return {};
    }
    zones = zones && time->has_zone;
    fractions = fractions && time->has_fraction;
    if (!times.empty() && !(time->time_s > times.back())) {
      fault = std::string(fractions ? "an" : "a whole second only as") + " EXIF time of " +
              image.filename().string() + " that is not later than the one before";
      return {};
    }
    times.push_back(time->time_s);
  }
  report.notes.push_back(std::string("the images are stamped with their EXIF times") +
                         (zones ? "" : ", whose time zone is not told: taken for UTC"));
  return times;
}

}  // namespace oneac
