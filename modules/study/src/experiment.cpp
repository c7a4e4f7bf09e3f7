#include "oneac/study/experiment.h"

#include <stdexcept>
#include <utility>

namespace oneac {
namespace {

using M = StudyMotion;
using P = StudySurface;
using S = StudySweep;

[[nodiscard]] std::vector<double> evenly(double first, double step, int count) {
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) values.push_back(first + step * i);
  return values;
}

[[nodiscard]] std::vector<Experiment> experiments_of_paper() {
  const StudyMethod pc4 = study_method("homography_4pc"), ac2 = study_method("homography_2ac");
  return {
      {"forward_ground",
       "Forward motion, ground",
       M::kForward,
       P::kGround,
       S::kNoise,
       {study_method("relpose_1ac_ground"), pc4, ac2}},
      {"forward_front",
       "Forward motion, frontal wall",
       M::kForward,
       P::kFrontWall,
       S::kNoise,
       {study_method("relpose_1ac_front_wall"), pc4, ac2}},
      {"forward_wall",
       "Forward motion, turned wall",
       M::kForward,
       P::kAnyWall,
       S::kWallAngle,
       {study_method("relpose_1ac_wall"), pc4, ac2}},
      {"sideways_wall",
       "Sideways motion, turned wall",
       M::kSideways,
       P::kAnyWall,
       S::kWallAngle,
       {study_method("relpose_1ac_wall"), pc4, ac2}},
      {"tilt_ground",
       "Forward motion, ground, tilted second camera",
       M::kForward,
       P::kGround,
       S::kTilt,
       {study_method("relpose_1ac_ground"), pc4, ac2}},
      {"tilt_front",
       "Forward motion, frontal wall, tilted second camera",
       M::kForward,
       P::kFrontWall,
       S::kTilt,
       {study_method("relpose_1ac_front_wall"), pc4, ac2}},
  };
}

[[nodiscard]] std::vector<Experiment> experiments_of_supplement() {
  const StudyMethod pc4 = study_method("homography_4pc"), ac2 = study_method("homography_2ac");
  return {
      {"sideways_ground",
       "Sideways motion, ground",
       M::kSideways,
       P::kGround,
       S::kNoise,
       {study_method("relpose_1ac_ground"), pc4, ac2}},
      {"sideways_side",
       "Sideways motion, side wall",
       M::kSideways,
       P::kSideWall,
       S::kNoise,
       {study_method("relpose_1ac_side_wall"), pc4, ac2}},
      {"rapid_ground",
       "Rapid against optimal, forward motion, ground",
       M::kForward,
       P::kGround,
       S::kNoise,
       {study_method("relpose_1ac_ground"), study_method("relpose_1ac_ground_rapid")}},
      {"rapid_front",
       "Rapid against optimal, forward motion, frontal wall",
       M::kForward,
       P::kFrontWall,
       S::kNoise,
       {study_method("relpose_1ac_front_wall"), study_method("relpose_1ac_front_wall_rapid")}},
  };
}

/// Beyond the paper: solvers of the same year, and what each assumes.
[[nodiscard]] std::vector<Experiment> experiments_of_siblings() {
  const StudyMethod vertical = study_method("relpose_1ac_vertical");
  const StudyMethod planar = study_method("relpose_1ac_planar");
  const StudyMethod ground = study_method("relpose_1ac_ground");
  const StudyMethod two = study_method("relpose_2ac");
  return {
      {"slope_ground",
       "Forward motion on a slope, vertical known to 0.1°",
       M::kForward,
       P::kGround,
       S::kSlope,
       {vertical, planar, ground, two}},
      {"level_ground",
       "Forward motion on a slope of 3 %, vertical known to",
       M::kForward,
       P::kGround,
       S::kLevel,
       {vertical, planar, ground, two}},
      {"focal_ground",
       "Turn on the ground, wrong focal length",
       M::kForward,
       P::kGround,
       S::kFocal,
       {study_method("relpose_1ac_planar_focal"), planar, ground}},
      {"circles_ground",
       "Null vector against two circles, forward motion, ground",
       M::kForward,
       P::kGround,
       S::kNoise,
       {planar, planar_two_circles()}},
      {"circles_sideways",
       "Null vector against two circles, sideways motion, ground",
       M::kSideways,
       P::kGround,
       S::kNoise,
       {planar, planar_two_circles()}},
  };
}

[[nodiscard]] std::vector<Experiment> all_experiments() {
  std::vector<Experiment> all = experiments_of_paper();
  for (Experiment& experiment : experiments_of_supplement()) all.push_back(std::move(experiment));
  for (Experiment& experiment : experiments_of_siblings()) all.push_back(std::move(experiment));
  return all;
}

}  // namespace

std::string Figure::name() const {
  return std::string(id) + "_" + std::string(experiment) + "_" + std::string(metric_name(metric));
}

const std::vector<Experiment>& experiments() {
  static const std::vector<Experiment> kExperiments = all_experiments();
  return kExperiments;
}

const std::vector<Figure>& figures() {
  const auto rotation = StudyMetric::kRotation, translation = StudyMetric::kTranslation;
  static const std::vector<Figure> kFigures = {
      {"a", "forward_ground", rotation},
      {"b", "forward_ground", translation},
      {"c", "forward_front", rotation},
      {"d", "forward_front", translation},
      {"e", "forward_wall", rotation},
      {"f", "forward_wall", translation},
      {"g", "sideways_wall", rotation},
      {"h", "sideways_wall", translation},
      {"i1", "tilt_ground", rotation},
      {"i2", "tilt_ground", translation},
      {"i3", "tilt_front", rotation},
      {"i4", "tilt_front", translation},
      {"s1", "sideways_ground", rotation},
      {"s2", "sideways_ground", translation},
      {"s3", "sideways_side", rotation},
      {"s4", "sideways_side", translation},
      {"s5", "forward_wall", StudyMetric::kNormal},
      {"s6", "sideways_wall", StudyMetric::kNormal},
      {"s7", "rapid_ground", rotation},
      {"s8", "rapid_ground", translation},
      {"s9", "rapid_front", rotation},
      {"s10", "rapid_front", translation},
      {"v1", "slope_ground", rotation},
      {"v2", "slope_ground", translation},
      {"v3", "level_ground", rotation},
      {"v4", "level_ground", translation},
      {"v5", "focal_ground", rotation},
      {"v6", "focal_ground", translation},
      {"v7", "circles_ground", rotation},
      {"v8", "circles_ground", translation},
      {"v9", "circles_sideways", rotation},
      {"v10", "circles_sideways", translation},
  };
  return kFigures;
}

const Experiment& experiment_named(std::string_view name) {
  for (const Experiment& experiment : experiments()) {
    if (experiment.name == name) return experiment;
  }
  throw std::invalid_argument("experiment: no such name: " + std::string(name));
}

std::vector<double> sweep_values(StudySweep sweep) {
  if (sweep == S::kWallAngle) return evenly(-80.0, 10.0, 17);
  if (sweep == S::kSlope) return evenly(0.0, 1.0, 11);
  if (sweep == S::kFocal) return evenly(-10.0, 2.0, 11);
  return evenly(0.0, 0.1, 11);
}

std::string_view sweep_column(StudySweep sweep) {
  if (sweep == S::kWallAngle) return "wall_angle_deg";
  if (sweep == S::kSlope) return "slope_percent";
  if (sweep == S::kLevel) return "vertical_deg";
  if (sweep == S::kFocal) return "focal_error_percent";
  return sweep == S::kTilt ? "tilt_deg" : "noise_px";
}

std::string_view sweep_label(StudySweep sweep) {
  if (sweep == S::kWallAngle) return "angle of the wall about the vertical [°]";
  if (sweep == S::kTilt) return "tilt of the second camera about its X axis [°]";
  if (sweep == S::kSlope) return "slope of the road [%]";
  if (sweep == S::kLevel) return "1σ of the known vertical, pitch and roll of each view [°]";
  if (sweep == S::kFocal) return "error of the assumed focal length [%]";
  return "point noise [px], with affine noise of 5° and 5 % per px";
}

std::string_view sweep_unit(StudySweep sweep) {
  if (sweep == S::kSlope || sweep == S::kFocal) return "%";
  return sweep == S::kNoise ? "px" : "°";
}

std::string_view metric_name(StudyMetric metric) {
  if (metric == StudyMetric::kNormal) return "normal";
  return metric == StudyMetric::kRotation ? "rotation" : "translation";
}

}  // namespace oneac
