#include "record_json.h"

#include "oneac/base/number_text.h"
#include "oneac/base/parameter_table.h"
#include "oneac/base/printable.h"
#include "oneac/robust/robust_result.h"

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <variant>

namespace oneac::internal {
namespace {

constexpr std::size_t kMost = std::size_t{1} << 40U;  // of anything that is counted
constexpr double kUnit = 1e-3;                        // as files of poses are read
constexpr double kLongest = 1e15;                     // [m] beyond any pose
constexpr double kWidest_deg = 150.0;                 // of an undistorted field of view
constexpr double kMostMs = 1e12;
constexpr int kMostTrials = 1000000;

[[noreturn]] void fail(const std::string& name, const Json& value, const std::string& bound) {
  throw std::invalid_argument(name + " is " + shortened(text_of(value), 60) + ", must be " + bound);
}

/// An integer below `end`.
std::size_t count_in(const Json& value, const std::string& name, std::size_t end = kMost) {
  const bool whole =
      value.is_number_unsigned() || (value.is_number_integer() && value.get<std::int64_t>() >= 0);
  if (!whole || value.get<std::uint64_t>() >= end) {
    fail(name, value, "a whole number from 0 to " + std::to_string(end - 1));
  }
  return value.get<std::size_t>();
}

double number_in(const Json& value, const std::string& name, double least, double most) {
  const bool good =
      value.is_number() && value.get<double>() >= least && value.get<double>() <= most;
  if (!good) fail(name, value, "a number from " + exact_text(least) + " to " + exact_text(most));
  return value.get<double>();
}

/// A path of any bytes: JSON takes UTF-8 only, so the bytes of another one are letters of Latin-1.
Json path_json(const std::string& path) {
  if (is_utf8(path)) return path;
  std::string letters;
  for (const char c : path) {
    const auto byte = static_cast<std::uint8_t>(c);
    if (byte >= 0x80) letters += static_cast<char>(0xc0U | byte >> 6U);
    letters += static_cast<char>(byte >= 0x80 ? 0x80U | (byte & 0x3fU) : byte);
  }
  return {{"bytes", letters}};
}

std::string path_from(const Json& json) {
  if (json.is_string()) return json.get<std::string>();
  const std::string letters = json.at("bytes").get<std::string>();
  std::string path;
  for (std::size_t i = 0; i < letters.size(); ++i) {
    const auto first = static_cast<std::uint8_t>(letters[i]);
    if (first < 0x80) {
      path += letters[i];
    } else if (++i < letters.size()) {
      path += static_cast<char>((first & 0x03U) << 6U |
                                (static_cast<std::uint8_t>(letters[i]) & 0x3fU));
    }
  }
  return path;
}

Json pose_json(const RelativePose& pose) {
  Eigen::Quaterniond q(pose.R);
  q.normalize();
  if (q.w() < 0.0) q.coeffs() *= -1.0;
  return Json::array({q.w(), q.x(), q.y(), q.z(), pose.t.x(), pose.t.y(), pose.t.z()});
}

RelativePose pose_from(const Json& json, const std::string& name) {
  if (!json.is_array() || json.size() != 7) fail(name, json, "qw, qx, qy, qz, tx, ty, tz");
  std::array<double, 7> v{};
  for (std::size_t i = 0; i < v.size(); ++i) v[i] = number_in(json[i], name, -kLongest, kLongest);
  const Eigen::Quaterniond q(v[0], v[1], v[2], v[3]);
  if (!(std::abs(q.norm() - 1.0) < kUnit)) fail(name, json, "of a quaternion of length 1");
  return {q.normalized().toRotationMatrix(), {v[4], v[5], v[6]}};
}

/// Borrows the settings' options.
ParameterTable table_of(CompareSettings& settings) {
  ParameterTable table;
  table.add("features", settings.features);
  table.add("tilt", settings.tilt);
  return table;
}

Json to_json(const MethodResult& r) {
  Json json = Json::array({r.method, r.trial, r.status, r.inliers, r.iterations, r.hypotheses,
                           r.local_optimisations, r.graph_cuts, r.ms});
  if (r.has_pose) json.push_back(pose_json(r.pose));
  if (!r.fault.empty()) json.push_back(r.fault);
  return json;
}

/// The word of a PoseStatus, or kInvalidAnswer.
std::string status_from(const Json& json) {
  std::string word = json.get<std::string>();
  for (const PoseStatus status : {PoseStatus::kOk, PoseStatus::kOnePlane, PoseStatus::kPureRotation,
                                  PoseStatus::kNoMotion, PoseStatus::kTooFew}) {
    if (word == to_string(status)) return word;
  }
  if (word != kInvalidAnswer) fail("status", json, "the status of an answer");
  return word;
}

bool status_has_pose(const std::string& status) {
  return status != kInvalidAnswer && status != to_string(PoseStatus::kTooFew);
}

/// The tenth entry: the pose, or what was wrong where the answer is none.
void take_answer(const Json& json, MethodResult& r) {
  r.has_pose = status_has_pose(r.status);
  const std::size_t entries = r.status == to_string(PoseStatus::kTooFew) ? 9 : 10;
  if (json.size() != entries) {
    fail("entries of a result " + r.status, json.size(), std::to_string(entries));
  }
  if (!r.has_pose && entries == 10) r.fault = printable(json[9].get<std::string>());
  if (!r.has_pose) return;
  r.pose = pose_from(json[9], "the pose of a result");
  const double length = r.pose.t.stableNorm();
  const bool travels =
      r.status == to_string(PoseStatus::kOk) || r.status == to_string(PoseStatus::kOnePlane);
  if (!(std::abs(length - (travels ? 1.0 : 0.0)) < kUnit)) {
    fail("the translation of a result " + r.status, json[9],
         std::string("of length ") + (travels ? "1" : "0"));
  }
}

MethodResult result_from(const Json& json, std::size_t acs) {
  if (!json.is_array() || json.size() < 9) fail("a result", json, "a list of 9 or 10 entries");
  MethodResult r;
  r.method = count_in(json[0], "method");
  r.trial = static_cast<int>(count_in(json[1], "trial", kMostTrials));
  r.status = status_from(json[2]);
  r.inliers = count_in(json[3], "inliers", acs + 1);
  r.iterations = count_in(json[4], "iterations");
  r.hypotheses = count_in(json[5], "hypotheses");
  r.local_optimisations = count_in(json[6], "local_optimisations");
  r.graph_cuts = count_in(json[7], "graph_cuts");
  r.ms = number_in(json[8], "ms", 0.0, kMostMs);
  take_answer(json, r);
  return r;
}

/// Every method and trial once, in the order in which they are computed.
void take_results(const Json& json, const CompareSettings& settings, PairRecord& record) {
  const auto trials = static_cast<std::size_t>(settings.trials);
  const std::size_t expected = settings.methods.size() * trials;
  if (!json.is_array() || json.size() != expected) {
    fail("results", json.size(), std::to_string(expected) + ", one per method and trial");
  }
  for (std::size_t i = 0; i < expected; ++i) {
    record.results.push_back(result_from(json[i], record.acs));
    const MethodResult& r = record.results.back();
    if (r.method != i / trials) fail("method", r.method, std::to_string(i / trials));
    if (r.trial != static_cast<int>(i % trials)) fail("trial", r.trial, std::to_string(i % trials));
  }
}

/// A line of the tables that no field can break.
std::string label_from(const Json& json) {
  std::string label = json.get<std::string>();
  if (label.empty() || printable(label) != label || label.find(',') != std::string::npos) {
    fail("the name of a method", json, "a word without comma");
  }
  return label;
}

void take_source(const Json& json, CompareSettings& settings) {
  for (const Json& log : json.at("logs")) settings.logs.push_back(path_from(log));
  settings.source.images_dir = path_from(json.at("images_dir"));
  if (json.contains("mask_dir")) settings.source.mask_dir = path_from(json["mask_dir"]);
  settings.source.camera = path_from(json.at("camera"));
  settings.source.calibration = path_from(json.at("calibration"));
  if (json.contains("undistorted_fov_deg")) {
    settings.source.undistorted_fov_deg =
        number_in(json["undistorted_fov_deg"], "undistorted_fov_deg", 0.0, kWidest_deg);
  }
  settings.source.mount_convention = json.at("mount_convention").get<std::string>();
  if (json.contains("mount_deg")) {
    const Json& mount = json["mount_deg"];
    const auto angle = [&](std::size_t i) {
      return number_in(mount.at(i), "mount_deg", -kLongest, kLongest);
    };
    settings.source.mount = MountAngles{angle(0), angle(1), angle(2)};
  }
  settings.source.first = count_in(json.at("first"), "first");
  settings.source.count = count_in(json.at("count"), "count");
  settings.source.every = count_in(json.at("every"), "every");
  settings.reference = path_from(json.at("reference"));
}

}  // namespace

std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json to_json(const CompareSettings& settings) {
  CompareSettings copy = settings;
  Json json;
  json["program"] = settings.program;
  json["plugins"] = settings.plugins;
  json["logs"] = Json::array();
  for (const std::string& log : settings.logs) json["logs"].push_back(path_json(log));
  json["images_dir"] = path_json(settings.source.images_dir.string());
  const std::string masks = settings.source.mask_dir.string();
  if (!masks.empty()) json["mask_dir"] = path_json(masks);
  json["camera"] = path_json(settings.source.camera);
  json["calibration"] = path_json(settings.source.calibration);
  if (const double fov = settings.source.undistorted_fov_deg; fov != 0.0) {
    json["undistorted_fov_deg"] = fov;
  }
  json["mount_convention"] = settings.source.mount_convention;
  if (const auto& mount = settings.source.mount) {
    json["mount_deg"] = {mount->roll_right_deg, mount->pitch_up_deg, mount->yaw_left_deg};
  }
  json["first"] = settings.source.first;
  json["count"] = settings.source.count;
  json["every"] = settings.source.every;
  const ParameterTable table = table_of(copy);
  for (const auto& parameter : table.parameters()) {
    // Names as they are: value_text() quotes them for YAML, set() takes them without.
    std::string* const* name = std::get_if<std::string*>(&parameter.target);
    json[parameter.key] = name != nullptr ? **name : table.value_text(parameter);
  }
  json["reference"] = path_json(settings.reference);
  json["methods"] = Json::array();
  for (const CompareMethod& m : settings.methods) {
    json["methods"].push_back({m.label, m.initialiser, m.estimator});
  }
  json["method_parameters"] = settings.method_parameters;
  json["trials"] = settings.trials;
  json["seed"] = settings.seed;
  return json;
}

CompareSettings settings_from(const Json& json) {
  CompareSettings settings;
  settings.program = json.at("program").get<std::string>();
  settings.plugins = json.at("plugins").get<std::vector<std::string>>();
  take_source(json, settings);
  ParameterTable table = table_of(settings);
  for (const auto& parameter : table.parameters()) {
    table.set(parameter.key, json.at(parameter.key).get<std::string>());
  }
  for (const Json& m : json.at("methods")) {
    settings.methods.push_back(
        {label_from(m.at(0)), m.at(1).get<std::string>(), m.at(2).get<std::string>()});
  }
  settings.method_parameters = json.at("method_parameters").get<std::string>();
  settings.trials = static_cast<int>(count_in(json.at("trials"), "trials", kMostTrials + 1));
  settings.seed = json.at("seed").get<std::uint64_t>();
  settings.validate();
  if (settings.methods.empty()) fail("methods", json.at("methods"), "one or more");
  return settings;
}

Json to_json(const LogRecord& record) {
  return {{"log", record.log},
          {"name", record.name},
          {"images", record.images},
          {"pairs", record.pairs},
          {"last_index", record.last_index},
          {"content", record.content},
          {"tilt", {record.tilt.pitch_up, record.tilt.roll_right}},
          {"reference", record.reference},
          {"course_sigma_deg", record.course_sigma_deg},
          {"heading_sigma_deg", record.heading_sigma_deg},
          {"heading_vs_gyro_deg", record.heading_vs_gyro_deg}};
}

LogRecord log_from(const Json& json, const CompareSettings& settings) {
  constexpr double kRightAngle = 1.6, kTurn_deg = 1e6;
  LogRecord record;
  record.log = count_in(json.at("log"), "log", settings.logs.size());
  record.name = json.at("name").get<std::string>();
  const std::string name = settings.log_names()[record.log];
  if (record.name != name) fail("name", json["name"], name);
  record.images = count_in(json.at("images"), "images");
  record.pairs = count_in(json.at("pairs"), "pairs");
  const std::size_t pairs = record.images == 0 ? 0 : record.images - 1;
  if (record.pairs != pairs) fail("pairs", json["pairs"], std::to_string(pairs));
  record.last_index = count_in(json.at("last_index"), "last_index");
  if (json.contains("content")) record.content = printable(json["content"].get<std::string>());
  if (json.at("tilt").size() != 2) fail("tilt", json["tilt"], "two numbers");
  record.tilt = {number_in(json.at("tilt").at(0), "tilt", -kRightAngle, kRightAngle),
                 number_in(json.at("tilt").at(1), "tilt", -kRightAngle * 2, kRightAngle * 2)};
  record.reference = printable(json.at("reference").get<std::string>());
  const auto angle = [&](const char* key) { return number_in(json.at(key), key, 0.0, kTurn_deg); };
  record.course_sigma_deg = angle("course_sigma_deg");
  record.heading_sigma_deg = angle("heading_sigma_deg");
  record.heading_vs_gyro_deg = angle("heading_vs_gyro_deg");
  return record;
}

Json to_json(const PairRecord& record) {
  Json json{{"log", record.log},       {"pair", record.ordinal}, {"index1", record.index1},
            {"index2", record.index2}, {"acs", record.acs},      {"truth", nullptr},
            {"results", Json::array()}};
  if (record.truth) json["truth"] = pose_json(*record.truth);
  for (const MethodResult& result : record.results) json["results"].push_back(to_json(result));
  return json;
}

std::size_t log_of_pair(const Json& json, const CompareSettings& settings) {
  return count_in(json.at("log"), "log", settings.logs.size());
}

PairRecord pair_from(const Json& json, const CompareSettings& settings, const LogRecord& log) {
  PairRecord record;
  record.log = log.log;
  record.ordinal = count_in(json.at("pair"), "pair", log.pairs);
  record.index1 = count_in(json.at("index1"), "index1", log.last_index + 1);
  record.index2 = count_in(json.at("index2"), "index2", log.last_index + 1);
  if (record.index1 >= record.index2) fail("index1", json["index1"], "below index2");
  // Pairs before this one and behind it have images of their own.
  if (record.index1 < record.ordinal) {
    fail("index1", json["index1"], "at least the pair's number");
  }
  const std::size_t behind = log.pairs - 1 - record.ordinal;
  if (record.index2 + behind > log.last_index) {
    fail("index2", json["index2"],
         "at most " + std::to_string(log.last_index) + " less the " + std::to_string(behind) +
             " pairs behind");
  }
  record.acs = count_in(json.at("acs"), "acs");
  if (!json.at("truth").is_null()) record.truth = pose_from(json["truth"], "truth");
  take_results(json.at("results"), settings, record);
  return record;
}

}  // namespace oneac::internal
