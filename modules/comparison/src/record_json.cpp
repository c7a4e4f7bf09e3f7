#include "record_json.h"

#include "oneac/base/parameter_table.h"

#include <Eigen/Geometry>

#include <variant>

namespace oneac::internal {
namespace {

Json pose_json(const RelativePose& pose) {
  Eigen::Quaterniond q(pose.R);
  q.normalize();
  if (q.w() < 0.0) q.coeffs() *= -1.0;
  return Json::array({q.w(), q.x(), q.y(), q.z(), pose.t.x(), pose.t.y(), pose.t.z()});
}

RelativePose pose_from(const Json& json) {
  const auto v = json.get<std::array<double, 7>>();
  return {Eigen::Quaterniond(v[0], v[1], v[2], v[3]).normalized().toRotationMatrix(),
          {v[4], v[5], v[6]}};
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
  return json;
}

MethodResult result_from(const Json& json) {
  MethodResult r;
  r.method = json.at(0).get<std::size_t>();
  r.trial = json.at(1).get<int>();
  r.status = json.at(2).get<std::string>();
  r.inliers = json.at(3).get<std::size_t>();
  r.iterations = json.at(4).get<std::size_t>();
  r.hypotheses = json.at(5).get<std::size_t>();
  r.local_optimisations = json.at(6).get<std::size_t>();
  r.graph_cuts = json.at(7).get<std::size_t>();
  r.ms = json.at(8).get<double>();
  r.has_pose = json.size() > 9;
  if (r.has_pose) r.pose = pose_from(json.at(9));
  return r;
}

}  // namespace

Json to_json(const CompareSettings& settings) {
  CompareSettings copy = settings;
  Json json;
  json["logs"] = settings.logs;
  json["images_dir"] = settings.source.images_dir.string();
  json["camera"] = settings.source.camera;
  json["calibration"] = settings.source.calibration;
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
  json["reference"] = settings.reference;
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
  settings.logs = json.at("logs").get<std::vector<std::string>>();
  settings.source.images_dir = json.at("images_dir").get<std::string>();
  settings.source.camera = json.at("camera").get<std::string>();
  settings.source.calibration = json.at("calibration").get<std::string>();
  settings.source.undistorted_fov_deg = json.value("undistorted_fov_deg", 0.0);
  settings.source.mount_convention = json.at("mount_convention").get<std::string>();
  if (json.contains("mount_deg")) {
    const Json& mount = json["mount_deg"];
    settings.source.mount = MountAngles{mount.at(0).get<double>(), mount.at(1).get<double>(),
                                        mount.at(2).get<double>()};
  }
  settings.source.first = json.at("first").get<std::size_t>();
  settings.source.count = json.at("count").get<std::size_t>();
  settings.source.every = json.at("every").get<std::size_t>();
  ParameterTable table = table_of(settings);
  for (const auto& parameter : table.parameters()) {
    table.set(parameter.key, json.at(parameter.key).get<std::string>());
  }
  settings.reference = json.at("reference").get<std::string>();
  for (const Json& m : json.at("methods")) {
    settings.methods.push_back(
        {m.at(0).get<std::string>(), m.at(1).get<std::string>(), m.at(2).get<std::string>()});
  }
  settings.method_parameters = json.at("method_parameters").get<std::string>();
  settings.trials = json.at("trials").get<int>();
  settings.seed = json.at("seed").get<std::uint64_t>();
  return settings;
}

Json to_json(const LogRecord& record) {
  return {{"log", record.log},
          {"name", record.name},
          {"images", record.images},
          {"pairs", record.pairs},
          {"tilt", {record.tilt.pitch_up, record.tilt.roll_right}},
          {"reference", record.reference},
          {"course_sigma_deg", record.course_sigma_deg},
          {"heading_sigma_deg", record.heading_sigma_deg},
          {"heading_vs_gyro_deg", record.heading_vs_gyro_deg}};
}

LogRecord log_from(const Json& json) {
  LogRecord record;
  record.log = json.at("log").get<std::size_t>();
  record.name = json.at("name").get<std::string>();
  record.images = json.at("images").get<std::size_t>();
  record.pairs = json.at("pairs").get<std::size_t>();
  record.tilt = {json.at("tilt").at(0).get<double>(), json.at("tilt").at(1).get<double>()};
  record.reference = json.at("reference").get<std::string>();
  record.course_sigma_deg = json.at("course_sigma_deg").get<double>();
  record.heading_sigma_deg = json.at("heading_sigma_deg").get<double>();
  record.heading_vs_gyro_deg = json.at("heading_vs_gyro_deg").get<double>();
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

PairRecord pair_from(const Json& json) {
  PairRecord record;
  record.log = json.at("log").get<std::size_t>();
  record.ordinal = json.at("pair").get<std::size_t>();
  record.index1 = json.at("index1").get<std::size_t>();
  record.index2 = json.at("index2").get<std::size_t>();
  record.acs = json.at("acs").get<std::size_t>();
  if (!json.at("truth").is_null()) record.truth = pose_from(json.at("truth"));
  for (const Json& result : json.at("results")) record.results.push_back(result_from(result));
  return record;
}

}  // namespace oneac::internal
