// What a frame costs from file to pose, against a yardstick that every machine has: OpenCV's
// corners (goodFeaturesToTrack) and its pyramidal Lucas-Kanade forwards and backwards, 700 points,
// windows of 21x21, five levels. Both see each image in turn on one thread, and only the CPU time
// of that thread counts, so that other jobs of a machine slow both alike. Whole drives are
// repeated; the ratio of a drive is that of its sums.
//
//   oneac_bench_end_to_end LOG [--runs N] [--json FILE] [--set KEY=VALUE]... [--camera NAME]
//                              [--calibration FILE[:SECTION]] [--first N] [--count N] [--every K]
//
// KEY is one of `front_end` in params/default.yaml: --set front_end.camera_height=1.65

#include "bench_main.h"

#include "oneac/base/median.h"
#include "oneac/base/number_text.h"
#include "oneac/base/parameter_table.h"
#include "oneac/base/thread_clock.h"
#include "oneac/base/version.h"
#include "oneac/frontend/front_end.h"
#include "oneac/rawlog/rawlog_source.h"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace oneac;

struct Settings {
  SourceOptions source;
  FrontEndOptions front_end;
  std::size_t runs = 5;
  std::string json;
};

/// CPU time of one drive [ms].
struct Costs {
  double decode = 0.0, features = 0.0, estimate = 0.0, refine = 0.0, rest = 0.0, yardstick = 0.0;
  std::size_t frames = 0;

  [[nodiscard]] double program() const { return decode + features + estimate + refine + rest; }
  [[nodiscard]] double ratio() const { return program() / yardstick; }
};

/// One of them over the drives, per frame.
struct Row {
  const char* name;
  double (*of)(const Costs&);
};

const std::vector<Row> kRows = {
    {"decode_ms", [](const Costs& c) { return c.decode / static_cast<double>(c.frames); }},
    {"features_ms", [](const Costs& c) { return c.features / static_cast<double>(c.frames); }},
    {"estimate_ms", [](const Costs& c) { return c.estimate / static_cast<double>(c.frames); }},
    {"refine_ms", [](const Costs& c) { return c.refine / static_cast<double>(c.frames); }},
    {"rest_ms", [](const Costs& c) { return c.rest / static_cast<double>(c.frames); }},
    {"program_ms", [](const Costs& c) { return c.program() / static_cast<double>(c.frames); }},
    {"yardstick_ms", [](const Costs& c) { return c.yardstick / static_cast<double>(c.frames); }},
    {"features_ratio", [](const Costs& c) { return c.features / c.yardstick; }},
    {"ratio", [](const Costs& c) { return c.ratio(); }},
};

void set(Settings& settings, const std::string& assignment) {
  const auto equals = assignment.find('=');
  if (equals == std::string::npos) throw std::invalid_argument("--set " + assignment + " has no =");
  ParameterTable table;
  table.add("front_end", settings.front_end);
  table.set(assignment.substr(0, equals), assignment.substr(equals + 1));
}

Settings read_settings(const std::vector<std::string>& words) {
  if (words.empty()) throw std::invalid_argument("give a rawlog");
  Settings s;
  s.source.log = words[0];
  for (std::size_t i = 1; i + 1 < words.size(); i += 2) {
    const std::string &key = words[i], &value = words[i + 1];
    if (key == "--runs") {
      s.runs = std::max<std::size_t>(std::stoul(value), 1);
    } else if (key == "--json") {
      s.json = value;
    } else if (key == "--set") {
      set(s, value);
    } else if (key == "--camera") {
      s.source.camera = value;
    } else if (key == "--calibration") {
      s.source.calibration = value;
    } else if (key == "--first") {
      s.source.first = std::stoul(value);
    } else if (key == "--count") {
      s.source.count = std::stoul(value);
    } else if (key == "--every") {
      s.source.every = std::stoul(value);
    } else {
      throw std::invalid_argument("unknown flag " + key);
    }
  }
  s.source.stereo = s.front_end.scale.source == "stereo";
  return s;
}

/// Corners of the image before, followed to this one and back.
class Yardstick {
 public:
  /// @return CPU time [ms]
  double follow(const cv::Mat& now) {
    double ms = 0.0;
    if (!before_.empty()) {
      const StageTimer timer(ms);
      std::vector<cv::Point2f> corners, there, back;
      cv::goodFeaturesToTrack(before_, corners, kPoints, kQuality, kDistance_px);
      if (!corners.empty()) {
        std::vector<unsigned char> found;
        std::vector<float> errors;
        const cv::Size window(21, 21);
        constexpr int kTopLevel = 4;
        cv::calcOpticalFlowPyrLK(before_, now, corners, there, found, errors, window, kTopLevel);
        cv::calcOpticalFlowPyrLK(now, before_, there, back, found, errors, window, kTopLevel);
      }
    }
    before_ = now;
    return ms;
  }

 private:
  static constexpr int kPoints = 700;
  static constexpr double kQuality = 0.01, kDistance_px = 10.0;
  cv::Mat before_;
};

cv::Mat copy_of(const GreyImage& image) {
  const ImageView view = image.view();
  const cv::Mat borrowed(view.height, view.width, CV_8UC1, const_cast<unsigned char*>(view.data),
                         static_cast<std::size_t>(view.stride));
  return borrowed.clone();
}

Costs drive(const Settings& settings) {
  Costs costs;
  RawlogSource source(settings.source);
  FrontEnd front_end(settings.front_end);
  Yardstick yardstick;
  while (const auto ticket = source.next()) {
    double whole_ms = 0.0;
    CameraFrame frame;
    {
      const StageTimer timer(costs.decode);
      frame = source.load(*ticket);
    }
    const cv::Mat image = copy_of(frame.image);
    FrameResult result;
    {
      const StageTimer timer(whole_ms);
      result = front_end.process(front_end.prepare(std::move(frame)));
    }
    if (result.step) {
      costs.features += result.step->features_ms;
      costs.estimate += result.step->estimate_ms;
      costs.refine += result.step->refine_ms;
      whole_ms -= result.step->features_ms + result.step->estimate_ms + result.step->refine_ms;
    }
    costs.rest += whole_ms;
    costs.yardstick += yardstick.follow(image);
    ++costs.frames;
  }
  if (costs.frames < 2) throw std::invalid_argument("the log has no two images");
  static_cast<void>(front_end.finish());
  return costs;
}

struct Spread {
  double median = 0.0, least = 0.0, most = 0.0;
};

Spread spread_of(const Row& row, const std::vector<Costs>& drives) {
  std::vector<double> values;
  for (const Costs& costs : drives) values.push_back(row.of(costs));
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return {upper_median(values), *least, *most};
}

/// Of the first processor; empty where the system does not say.
std::string machine() {
  std::ifstream cpus("/proc/cpuinfo");
  for (std::string line; std::getline(cpus, line);) {
    const auto colon = line.find(": ");
    if (line.rfind("model name", 0) == 0 && colon != std::string::npos) {
      return line.substr(colon + 2);
    }
  }
  return "";
}

/// Of the sources that this was built from; empty where they are no checkout.
std::string commit() {
  FILE* git = popen("git -C \"" ONEAC_SOURCE_DIR "\" describe --always --dirty 2>/dev/null", "r");
  if (git == nullptr) return "";
  char line[128] = {};
  std::string text = std::fgets(line, sizeof line, git) != nullptr ? line : "";
  pclose(git);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

void print(const std::vector<Costs>& drives) {
  std::printf("| per frame | median | least | most |\n|---|---|---|---|\n");
  for (const Row& row : kRows) {
    const Spread spread = spread_of(row, drives);
    std::printf("| %s | %.3f | %.3f | %.3f |\n", row.name, spread.median, spread.least,
                spread.most);
  }
}

void write_json(const Settings& settings, const std::vector<Costs>& drives) {
  std::ofstream out(settings.json);
  out << "{\n  \"version\": \"" << version() << "\",\n  \"commit\": \"" << commit()
      << "\",\n  \"machine\": \"" << machine() << "\",\n  \"log\": \""
      << settings.source.log.filename().string() << "\",\n  \"every\": " << settings.source.every
      << ",\n  \"frames\": " << drives.front().frames << ",\n  \"runs\": " << drives.size();
  for (const Row& row : kRows) {
    const Spread spread = spread_of(row, drives);
    out << ",\n  \"" << row.name << "\": {\"median\": " << fixed_text(spread.median, 4)
        << ", \"least\": " << fixed_text(spread.least, 4)
        << ", \"most\": " << fixed_text(spread.most, 4) << "}";
  }
  out << "\n}\n";
  if (!out) throw std::runtime_error("cannot write " + settings.json);
}

int run(int argc, char** argv) {
  cv::setNumThreads(1);  // the thread's clock sees all that OpenCV does
  const Settings settings = read_settings({argv + 1, argv + argc});
  std::vector<Costs> drives;
  for (std::size_t i = 0; i < settings.runs; ++i) drives.push_back(drive(settings));
  print(drives);
  if (!settings.json.empty()) write_json(settings, drives);
  return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) {
  return oneac::guarded("oneac_bench_end_to_end", run, argc, argv);
}
