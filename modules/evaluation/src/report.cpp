#include "oneac/evaluation/report.h"

#include "oneac/base/number_text.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <optional>
#include <string_view>

namespace oneac {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kDegrees = 57.29577951308232;  // per radian
constexpr double kPercent = 100.0;
constexpr double kPer100m = 100.0;
constexpr std::size_t kNameWidth = 22;
constexpr std::size_t kNumberWidth = 11;
constexpr int kDecimals = 4;

std::string right(std::string text, std::size_t width = kNumberWidth) {
  return std::string(width - std::min(width, text.size()), ' ') + std::move(text);
}

std::string left(std::string text) {
  text.resize(std::max(kNameWidth, text.size()), ' ');
  return text;
}

std::string number(double value) {
  return right(fixed_text(value, kDecimals));
}

std::string number(const std::optional<double>& value, double unit) {
  return value ? number(*value * unit) : right("-");
}

std::string count_line(const std::string& name, std::size_t count, const std::string& note) {
  return left(name) + right(std::to_string(count)) + (note.empty() ? "" : "  " + note) + '\n';
}

std::string value_line(const std::string& name, const std::optional<double>& value, double unit) {
  return left(name) + number(value, unit) + '\n';
}

std::string statistics_header() {
  std::string line = left("");
  for (const char* name : {"mean", "median", "95%", "rmse", "max"}) line += right(name);
  return line + '\n';
}

std::string statistics_line(const std::string& name, const std::optional<Statistics>& s,
                            double unit) {
  if (!s) return left(name) + right("-") + '\n';
  std::string line = left(name);
  for (double v : {s->mean, s->median, s->p95, s->rmse, s->max}) line += number(v * unit);
  return line + '\n';
}

std::string pair_lines(const std::vector<PairError>& pairs) {
  std::string text;
  for (const char* name : {"index1", "index2", "step_m", "rot_deg", "dir_deg", "length_%"}) {
    text += right(name);
  }
  text += '\n';
  for (const PairError& p : pairs) {
    text += right(std::to_string(p.index1)) + right(std::to_string(p.index2)) +
            number(p.true_step) + number(p.rotation * kDegrees) + number(p.direction, kDegrees) +
            number(p.length, kPercent) + (p.is_bad() ? "  bad" : "") + '\n';
  }
  return text + '\n';
}

std::string pair_table(const PairSummary& s) {
  const std::size_t directions = s.direction ? s.direction->count : 0;
  return count_line("pairs", s.pairs,
                    std::to_string(s.without_reference) + " more without a reference") +
         count_line("moving > 0.1 m", s.moving,
                    "direction known for " + std::to_string(directions) + ", metric " +
                        std::to_string(s.metric)) +
         count_line("bad", s.bad, "rotation > 1 deg or direction > 15 deg") + statistics_header() +
         statistics_line("rotation [deg]", s.rotation, kDegrees) +
         statistics_line("direction [deg]", s.direction, kDegrees) +
         statistics_line("length error [%]", s.length, kPercent);
}

std::string trajectory_table(const Evaluation& evaluation, const TrajectoryErrors& e) {
  const auto& sub = e.subsequences;
  const auto t_rel = sub ? std::optional(sub->translation) : std::nullopt;
  const auto r_rel = sub ? std::optional(sub->rotation) : std::nullopt;
  std::string text =
      count_line("frames", e.frames,
                 "of " + std::to_string(evaluation.estimate_frames) + " estimated, " +
                     std::to_string(evaluation.reference_frames) + " in the reference") +
      value_line("length [m]", e.length, 1.0) + value_line("t_rel [%]", t_rel, kPercent) +
      value_line("r_rel [deg/100 m]", r_rel, kDegrees * kPer100m) +
      value_line("scale error [%]", e.scale_error, kPercent);
  if (e.alignment == Alignment::kSim3) text += value_line("scale applied", e.aligned_scale, 1.0);
  return text + statistics_header() +
         statistics_line("APE " + name_of(e.alignment) + " [m]", e.ape, 1.0) +
         statistics_line("RPE [m]", e.rpe_translation, 1.0) +
         statistics_line("RPE [deg]", e.rpe_rotation, kDegrees);
}

Json to_json(const std::optional<double>& value, double unit) {
  return value ? Json(*value * unit) : Json(nullptr);
}

Json to_json(const std::optional<Statistics>& s, double unit) {
  if (!s) return nullptr;
  return {{"count", s->count},    {"mean", s->mean * unit}, {"median", s->median * unit},
          {"p95", s->p95 * unit}, {"rmse", s->rmse * unit}, {"max", s->max * unit}};
}

Json to_json(const PairError& p) {
  return {{"index1", p.index1},
          {"index2", p.index2},
          {"true_step_m", p.true_step},
          {"rotation_deg", p.rotation * kDegrees},
          {"direction_deg", to_json(p.direction, kDegrees)},
          {"length_error_percent", to_json(p.length, kPercent)},
          {"bad", p.is_bad()}};
}

Json to_json(const PairSummary& s) {
  return {{"pairs", s.pairs},
          {"without_reference", s.without_reference},
          {"moving", s.moving},
          {"metric", s.metric},
          {"bad", s.bad},
          {"rotation_deg", to_json(s.rotation, kDegrees)},
          {"direction_deg", to_json(s.direction, kDegrees)},
          {"length_error_percent", to_json(s.length, kPercent)}};
}

Json to_json(const Evaluation& evaluation, const TrajectoryErrors& e) {
  const auto& sub = e.subsequences;
  return {{"frames", e.frames},
          {"estimate_frames", evaluation.estimate_frames},
          {"reference_frames", evaluation.reference_frames},
          {"length_m", e.length},
          {"subsequences", sub ? sub->count : 0},
          {"t_rel_percent", sub ? Json(sub->translation * kPercent) : Json(nullptr)},
          {"r_rel_deg_per_100m", sub ? Json(sub->rotation * kDegrees * kPer100m) : Json(nullptr)},
          {"scale_error_percent", to_json(e.scale_error, kPercent)},
          {"alignment", name_of(e.alignment)},
          {"aligned_scale", e.aligned_scale},
          {"ape_m", to_json(e.ape, 1.0)},
          {"rpe_translation_m", to_json(e.rpe_translation, 1.0)},
          {"rpe_rotation_deg", to_json(e.rpe_rotation, kDegrees)}};
}

}  // namespace

std::string format_table(const Evaluation& evaluation, bool each_pair) {
  std::string text;
  if (evaluation.pair_summary) {
    if (each_pair) text += pair_lines(evaluation.pairs);
    text += pair_table(*evaluation.pair_summary);
  }
  if (evaluation.trajectory) {
    if (!text.empty()) text += '\n';
    text += trajectory_table(evaluation, *evaluation.trajectory);
  }
  return text;
}

std::string format_json(const Evaluation& evaluation, bool each_pair) {
  Json json = Json::object();
  if (evaluation.pair_summary) {
    if (each_pair) {
      json["pairs"] = Json::array();
      for (const PairError& pair : evaluation.pairs) json["pairs"].push_back(to_json(pair));
    }
    json["pair_summary"] = to_json(*evaluation.pair_summary);
  }
  if (evaluation.trajectory) json["trajectory"] = to_json(evaluation, *evaluation.trajectory);
  if (evaluation.offset_s) json["offset_s"] = *evaluation.offset_s;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace oneac
