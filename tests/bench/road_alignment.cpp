// How long a step is by the road alone, pair by pair, and whether its 1-sigma is true.
//
//   oneac_bench_road_alignment IMAGES RUN --camera FX,CX,CY --height H [--suffix TEXT]
//       [--poses KITTI | --truth LENGTH | --truth-list M0,M1,... --per N] [--mask-below ROW]
//       [--offset N] [--predict SIGMA] [--max-length M] [--every K] [--verbose 1] [--draw PREFIX]
//
// IMAGES is a folder (pictures in the order of their names); RUN is a folder of `oneac run`, whose
// relative_poses.csv gives rotation and direction and whose tilt.csv levels the camera.
// --predict S predicts each length by the one measured last, to S metres; without it nothing is
// predicted but --max-length.

#include "oneac/features/road_alignment.h"

#include "oneac/base/thread_clock.h"
#include "oneac/geometry/levelling.h"

#include <Eigen/Geometry>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using namespace oneac;

constexpr double kDegree = 3.14159265358979323846 / 180.0;

using Row = std::map<std::string, std::string>;

std::vector<std::string> split(const std::string& text, char by) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, by);) parts.push_back(part);
  return parts;
}

std::vector<Row> read_csv(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error("cannot read " + file.string());
  std::vector<Row> rows;
  std::vector<std::string> names;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    const auto words = split(line, ',');
    if (names.empty()) {
      names = words;
      continue;
    }
    Row row;
    for (std::size_t i = 0; i < std::min(names.size(), words.size()); ++i) row[names[i]] = words[i];
    rows.push_back(row);
  }
  return rows;
}

double number(const Row& row, const std::string& name) {
  const auto found = row.find(name);
  if (found == row.end()) throw std::runtime_error("no column " + name);
  return std::stod(found->second);
}

struct Settings {
  std::string images, run;
  std::map<std::string, std::string> values;

  [[nodiscard]] std::string text(const std::string& key) const {
    const auto found = values.find(key);
    return found == values.end() ? "" : found->second;
  }
  [[nodiscard]] double value(const std::string& key, double otherwise) const {
    const std::string found = text(key);
    return found.empty() ? otherwise : std::stod(found);
  }
};

Settings read_settings(int argc, char** argv) {
  if (argc < 3) throw std::invalid_argument("give a folder of images and one of a run");
  Settings s{argv[1], argv[2], {}};
  for (int i = 3; i + 1 < argc; i += 2) s.values[argv[i]] = argv[i + 1];
  return s;
}

std::vector<std::string> image_files(const Settings& s) {
  std::vector<std::string> files;
  const std::string suffix = s.text("--suffix");
  for (const auto& entry : std::filesystem::directory_iterator(s.images)) {
    const std::string name = entry.path().string();
    const bool fits = name.size() >= suffix.size() &&
                      name.compare(name.size() - suffix.size(), suffix.size(), suffix) == 0;
    if (entry.is_regular_file() && fits) files.push_back(name);
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// True length of the step from image i to j [m]; empty: not known.
class Truth {
 public:
  explicit Truth(const Settings& s) : constant_(s.value("--truth", 0.0)) {
    per_ = static_cast<std::size_t>(s.value("--per", 20));
    for (const std::string& word : split(s.text("--truth-list"), ','))
      list_.push_back(std::stod(word));
    std::ifstream in(s.text("--poses"));
    for (std::string line; std::getline(in, line);) {
      std::istringstream words(line);
      std::vector<double> m;
      for (double value = 0; words >> value;) m.push_back(value);
      if (m.size() == 12) centres_.emplace_back(m[3], m[7], m[11]);
    }
  }
  [[nodiscard]] std::optional<double> length(std::size_t i, std::size_t j) const {
    if (constant_ > 0.0) return constant_ * static_cast<double>(j - i);
    if (j < centres_.size()) return (centres_[j] - centres_[i]).norm();
    if (i / per_ < list_.size())
      return list_[i / per_] / static_cast<double>(per_) * static_cast<double>(j - i);
    return std::nullopt;
  }

 private:
  double constant_ = 0.0;
  std::size_t per_ = 20;
  std::vector<double> list_;
  std::vector<Eigen::Vector3d> centres_;
};

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

struct Tally {
  std::map<std::string, int> status;
  std::vector<double> lengths, ratios, errors, sigmas, ms;

  void print() const {
    std::size_t pairs = 0;
    for (const auto& [name, count] : status) pairs += static_cast<std::size_t>(count);
    std::printf("pairs %zu measured %zu (%.1f %%)", pairs, lengths.size(),
                100.0 * static_cast<double>(lengths.size()) /
                    static_cast<double>(std::max<std::size_t>(pairs, 1)));
    for (const auto& [name, count] : status) std::printf("  %s %d", name.c_str(), count);
    double sum = 0.0;
    for (const double length : lengths) sum += length;
    std::printf("\nlength sum %.2f m median %.4f m, stated sigma median %.2f %%, median %.2f ms\n",
                sum, median(lengths), 100.0 * median(sigmas), median(ms));
    if (ratios.empty()) return;
    std::vector<double> off;
    for (const double ratio : ratios) off.push_back(std::abs(ratio - median(ratios)));
    std::size_t two = 0, five = 0;
    for (const double error : errors) {
      two += error <= 2.0 ? 1U : 0U;
      five += error > 5.0 ? 1U : 0U;
    }
    std::printf("ratio to truth: median %.4f, scatter (1.48 MAD) %.2f %%, 5..95 %% %.4f..%.4f\n",
                median(ratios), 148.26 * median(off), quantile(ratios, 0.05),
                quantile(ratios, 0.95));
    std::printf("error over sigma: within 2: %.1f %%, above 5: %zu, largest %.1f\n",
                100.0 * static_cast<double>(two) / static_cast<double>(errors.size()), five,
                quantile(errors, 1.0));
  }
};

struct Frame {
  GreyImage image;
  RoadImage road;
};

Frame load(const std::string& file) {
  const cv::Mat grey = cv::imread(file, cv::IMREAD_GRAYSCALE);
  if (grey.empty()) throw std::runtime_error("cannot read " + file);
  Frame frame;
  frame.image = GreyImage(ImageView{grey.data, grey.cols, grey.rows, static_cast<int>(grey.step)});
  frame.road = RoadImage(frame.image.view());
  return frame;
}

/// The two images' difference after the second is warped onto the first by the road.
void draw(const std::string& file, const Frame& first, const Frame& second,
          const PinholeCamera& camera, const RoadAlignment& result) {
  cv::Mat out(camera.height, camera.width, CV_8UC1, cv::Scalar(128));
  const Eigen::Matrix3d H = result.T_2_1.R + result.T_2_1.t * result.normal.transpose();
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Eigen::Vector2d x = camera.normalise(Eigen::Vector2d(u, v));
      const Eigen::Vector3d X = H * x.homogeneous();
      const int grey = first.image.row(v)[u];
      out.at<unsigned char>(v, u) = static_cast<unsigned char>(grey / 2);
      if (result.normal.dot(x.homogeneous()) < 0.05 || X.z() <= 0.0) continue;
      const Eigen::Vector2d w = camera.project({X.x() / X.z(), X.y() / X.z()});
      const long c = std::lround(w.x()), r = std::lround(w.y());
      if (c < 0 || r < 0 || c >= camera.width || r >= camera.height) continue;
      const int other = second.image.row(static_cast<int>(r))[c];
      out.at<unsigned char>(v, u) =
          static_cast<unsigned char>(std::clamp(128 + 3 * (other - grey), 0, 255));
    }
  }
  cv::imwrite(file, out);
}

RoadStep step_of(const Row& pair, const Row& tilt, double height, const Settings& s) {
  RoadStep step;
  step.T_2_1.R = Eigen::Quaterniond(number(pair, "qw"), number(pair, "qx"), number(pair, "qy"),
                                    number(pair, "qz"))
                     .normalized()
                     .toRotationMatrix();
  step.T_2_1.t = {number(pair, "tx"), number(pair, "ty"), number(pair, "tz")};
  step.information =
      motion_information(s.value("--rotation-sigma", 0.0004), s.value("--direction-sigma", 0.01));
  const double pitch = number(tilt, "pitch_up_deg") + number(tilt, "suspension_pitch_deg");
  step.R_level_cam =
      levelling_rotation({pitch * kDegree, number(tilt, "roll_right_deg") * kDegree});
  step.pitch_sigma = kDegree * std::clamp(number(tilt, "suspension_sigma_deg"),
                                          s.value("--least-pitch-sigma", 0.1), 1.0);
  step.roll_sigma =
      kDegree * s.value("--roll-sigma", std::clamp(number(tilt, "roll_sigma_deg"), 0.3, 1.5));
  step.max_length = s.value("--max-length", 3.0) / height;
  return step;
}

/// Options by their names, "--road.heave 0.01".
struct ReadOptions {
  const Settings& settings;

  template <class Field>
  void operator()(const char* key, Field& field, const char*, const char*,
                  const Bound& = {}) const {
    field = static_cast<Field>(settings.value(std::string("--road.") + key, field));
  }
};

void run(const Settings& s) {
  RoadAlignmentOptions options;
  describe(ReadOptions{s}, options);
  const auto files = image_files(s);
  const auto pairs = read_csv(s.run + "/relative_poses.csv"), tilts = read_csv(s.run + "/tilt.csv");
  const auto intrinsics = split(s.text("--camera"), ',');
  const double height = s.value("--height", 1.5);
  const Truth truth(s);
  std::map<std::size_t, Row> tilt_of;
  for (const Row& row : tilts) tilt_of[static_cast<std::size_t>(number(row, "index"))] = row;
  std::map<std::size_t, Frame> frames;
  // Of the first image of the folder in the log.
  const auto offset = static_cast<std::size_t>(s.value("--offset", 0));
  Tally tally;
  double last = 0.0;
  Eigen::Vector3d heading(0.0, 0.0, -1.0);
  for (const Row& pair : pairs) {
    const auto index = static_cast<std::size_t>(number(pair, "index1"));
    const std::size_t i = index - offset;
    const std::size_t j = static_cast<std::size_t>(number(pair, "index2")) - offset;
    if (index < offset || j >= files.size() || tilt_of.count(index) == 0) continue;
    frames.erase(frames.begin(), frames.lower_bound(i));
    for (const std::size_t k : {i, j}) {
      if (frames.count(k) == 0) frames[k] = load(files[k]);
    }
    const Frame &first = frames[i], &second = frames[j];
    PinholeCamera camera;
    camera.width = first.image.width();
    camera.height = first.image.height();
    camera.fx = camera.fy = std::stod(intrinsics.at(0));
    camera.cx = std::stod(intrinsics.at(1));
    camera.cy = std::stod(intrinsics.at(2));
    RoadStep step = step_of(pair, tilt_of[index], height, s);
    if (step.T_2_1.t.norm() > 1e-9) {
      heading = step.T_2_1.t.normalized();
    } else {
      step.T_2_1.t = heading;
      step.information = motion_information(0.0005, 0.03);
    }
    if (s.value("--predict", 0.0) > 0.0 && last > 0.0) {
      step.length = last;
      step.length_sigma = s.value("--predict", 0.0) / height;
    }
    GreyImage mask;
    const int below = static_cast<int>(s.value("--mask-below", 0));
    if (below > 0) {
      mask = GreyImage(camera.width, camera.height, 255);
      for (int v = below; v < camera.height; ++v)
        std::fill_n(mask.row(v), camera.width, std::uint8_t{0});
    }
    const double before = thread_cpu_ms();
    const RoadAlignment result =
        align_road({first.road, second.road, mask.view()}, camera, step, options);
    tally.ms.push_back(thread_cpu_ms() - before);
    ++tally.status[to_string(result.status)];
    const double metres = height * result.length;
    const auto expected = truth.length(i, j);
    const bool measured = result.status == RoadStatus::kMeasured;
    if (s.value("--verbose", 0) > 0) {
      std::printf(
          "%4zu %4zu %-15s %.4f +- %.4f  truth %.4f  rho %.2f blocks %2d textured %2d rival %.2f "
          "at %.3f gain %.3f roll %.2f +- %.2f deg\n",
          i, j, to_string(result.status), metres, height * result.sigma, expected.value_or(0.0),
          result.correlation, result.blocks, result.textured, result.rival,
          height * result.rival_length, result.gain, result.roll / kDegree,
          result.roll_sigma / kDegree);
    }
    if (!s.text("--draw").empty() && i % 40 == 0)
      draw(s.text("--draw") + std::to_string(i) + ".png", first, second, camera, result);
    if (!measured) continue;
    last = result.length;
    tally.lengths.push_back(metres);
    tally.sigmas.push_back(result.relative_sigma);
    if (!expected) continue;
    tally.errors.push_back(std::abs(metres - *expected) / (height * result.sigma));
    if (*expected > 0.05) tally.ratios.push_back(metres / *expected);
  }
  tally.print();
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run(read_settings(argc, argv));
  } catch (const std::exception& error) {
    std::cerr << "road_alignment: " << error.what() << "\n";
    return 1;
  }
  return 0;
}
