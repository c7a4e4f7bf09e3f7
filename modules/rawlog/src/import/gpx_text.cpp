#include "import/gps_order.h"
#include "import/gps_text.h"
#include "import/stamps.h"

#include "oneac/base/error.h"
#include "oneac/base/finite_number.h"
#include "oneac/base/input_file.h"

#include <expat.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <string>

namespace oneac {
namespace {

namespace fs = std::filesystem;

// Expat 2.9 deprecates the one that counts in a type of its own.
std::size_t line_of(XML_Parser parser) {
#if XML_MAJOR_VERSION > 2 || XML_MINOR_VERSION >= 9
  return XML_GetCurrentLineNumber64(parser);
#else
  return XML_GetCurrentLineNumber(parser);
#endif
}

/// Of an attribute; null when it is not there.
std::optional<double> number(const char* text) {
  return text == nullptr ? std::nullopt : finite_number(text);
}

/// What is read of a GPX file: <trkpt lat= lon=><ele/><time/></trkpt>.
class Track {
 public:
  explicit Track(XML_Parser parser) : parser_(parser) {}

  void open(const std::string& element, const char** attributes) {
    text_.clear();
    if (element != "trkpt") return;
    const auto latitude = number(attribute(attributes, "lat"));
    const auto longitude = number(attribute(attributes, "lon"));
    const bool sound =
        latitude && longitude && std::abs(*latitude) <= 90.0 && std::abs(*longitude) <= 180.0;
    if (!sound) return fail("trkpt has no lat and lon in degrees");
    point_.emplace();
    point_->label = "gps";
    point_->time_s = kNoTime;
    point_->position = {*latitude, *longitude, unknown_height()};
  }
  void add_text(const char* text, std::size_t length) {
    constexpr std::size_t kLongest = 100;  // of a number or a time
    if (point_ && text_.size() < kLongest) text_.append(text, std::min(length, kLongest));
  }
  void close(const std::string& element) {
    if (!point_) return;
    if (element == "ele")
      point_->position.altitude_m = finite_number(trimmed()).value_or(unknown_height());
    if (element == "time") {
      const auto time = date_stamp(trimmed());
      if (!time) return fail("time '" + trimmed() + "' is none such as 2024-05-01T10:00:00Z");
      point_->time_s = *time;
      without_zone_ += names_zone(trimmed()) ? 0 : 1;
    }
    if (element == "trkpt") finish_point();
  }

  [[nodiscard]] const std::string& fault() const { return fault_; }
  [[nodiscard]] std::size_t line() const { return line_; }
  [[nodiscard]] std::size_t passed_over() const { return passed_over_; }
  [[nodiscard]] std::size_t without_zone() const { return without_zone_; }
  [[nodiscard]] std::vector<GpsRecord>& points() { return points_; }

 private:
  static constexpr double kNoTime = -1.0;

  static const char* attribute(const char** attributes, const char* name) {
    for (; attributes[0] != nullptr; attributes += 2) {
      if (std::strcmp(attributes[0], name) == 0) return attributes[1];
    }
    return nullptr;
  }
  [[nodiscard]] std::string trimmed() const {
    const auto begin = text_.find_first_not_of(" \t\r\n");
    if (begin == std::string::npos) return "";
    return text_.substr(begin, text_.find_last_not_of(" \t\r\n") - begin + 1);
  }
  void finish_point() {
    if (point_->time_s == kNoTime) {
      ++passed_over_;
    } else {
      points_.push_back(*point_);
    }
    point_.reset();
  }
  void fail(const std::string& fault) {
    fault_ = fault;
    line_ = line_of(parser_);
    XML_StopParser(parser_, XML_FALSE);
  }

  XML_Parser parser_;
  std::optional<GpsRecord> point_;
  std::string text_;
  std::vector<GpsRecord> points_;
  std::size_t passed_over_ = 0, without_zone_ = 0, line_ = 0;
  std::string fault_;
};

void parse(XML_Parser parser, Track& track, const std::string& text, const fs::path& file) {
  XML_SetUserData(parser, &track);
  XML_SetElementHandler(
      parser,
      [](void* to, const char* name, const char** attributes) {
        static_cast<Track*>(to)->open(name, attributes);
      },
      [](void* to, const char* name) { static_cast<Track*>(to)->close(name); });
  XML_SetCharacterDataHandler(parser, [](void* to, const char* some, int length) {
    static_cast<Track*>(to)->add_text(some, static_cast<std::size_t>(length));
  });
  const bool read =
      XML_Parse(parser, text.data(), static_cast<int>(text.size()), XML_TRUE) == XML_STATUS_OK;
  if (read) return;
  const bool own = !track.fault().empty();
  const std::size_t line = own ? track.line() : line_of(parser);
  const std::string fault =
      own ? track.fault()
          : std::string("it is no XML (") + XML_ErrorString(XML_GetErrorCode(parser)) + ")";
  throw InputError(file.string() + ": line " + std::to_string(line), fault,
                   "export the track again");
}

}  // namespace

std::vector<GpsRecord> read_gpx(const fs::path& file, ImportReport& report) {
  constexpr std::size_t kLongest = 1U << 30;  // what expat takes at once
  std::ifstream stream = open_input(file, "check its name");
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  if (text.size() > kLongest) throw InputError(file.string(), "is too long for a track", "cut it");
  const std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser(
      XML_ParserCreate(nullptr), &XML_ParserFree);
  Track track(parser.get());
  parse(parser.get(), track, text, file);
  const std::size_t passed_over = track.passed_over() + put_in_order(track.points());
  if (track.points().empty()) {
    throw InputError(file.string(), "it holds no trkpt with a time",
                     "export the track with its times");
  }
  note_times_without_zone(track.without_zone(), file, report);
  if (passed_over > 0) {
    report.notes.push_back(
        std::to_string(passed_over) + " points of " + file.filename().string() +
        " have no time, one of another day or one that is not later than the one before, or are at "
        "0, 0");
  }
  fill_heights(track.points());
  return std::move(track.points());
}

}  // namespace oneac
