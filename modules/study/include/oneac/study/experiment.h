#pragma once

#include "oneac/study/method.h"

#include <string>
#include <string_view>
#include <vector>

namespace oneac {

enum class StudyMotion { kForward, kSideways };                        ///< along Z, along X
enum class StudySurface { kGround, kFrontWall, kSideWall, kAnyWall };  ///< all at distance 1
enum class StudySweep {
  kNoise,
  kWallAngle,
  kTilt,   ///< of the second camera, which nobody knows
  kSlope,  ///< of the road, the vertical known to kKnownVerticalDeg
  kLevel,  ///< how well the vertical is known, on a road of kLevelSlope
  kFocal,  ///< error of the assumed focal length, in a turn
};

constexpr double kKnownVerticalDeg = 0.1;  ///< 1σ of pitch and roll, the same in both views [deg]
constexpr double kLevelSlope = 3.0;        ///< [%]; there each view has an error of its own
enum class StudyMetric { kRotation, kTranslation, kNormal };  ///< ξ_R, ξ_t, ξ_n of the paper

/// One series of measurements: a scene, a quantity that is varied, and who takes part.
struct Experiment {
  std::string_view name;   ///< unique; the seeds of its trials follow from it
  std::string_view title;  ///< for figures
  StudyMotion motion;
  StudySurface surface;
  StudySweep sweep;
  std::vector<StudyMethod> methods;  ///< ours first
};

/// A figure shows one error of one experiment.
struct Figure {
  std::string_view id;  ///< the paper's letter, i1 … for its (i), s1 … for its supplement
  std::string_view experiment;  ///< name of it
  StudyMetric metric;

  /// "a_forward_ground_rotation": name of its files.
  [[nodiscard]] std::string name() const;
};

/// All experiments and all figures, in the order of the paper, the supplement's last.
[[nodiscard]] const std::vector<Experiment>& experiments();
[[nodiscard]] const std::vector<Figure>& figures();
/// @throws std::invalid_argument for a name that no experiment has
[[nodiscard]] const Experiment& experiment_named(std::string_view name);

/// The values that the quantity takes, in its unit: px, ° or %.
[[nodiscard]] std::vector<double> sweep_values(StudySweep sweep);
/// What a sweep is called: column of the CSV, and label of the axis.
[[nodiscard]] std::string_view sweep_column(StudySweep sweep);
[[nodiscard]] std::string_view sweep_label(StudySweep sweep);
/// "px" or "°".
[[nodiscard]] std::string_view sweep_unit(StudySweep sweep);
/// "rotation", "translation" or "normal".
[[nodiscard]] std::string_view metric_name(StudyMetric metric);

}  // namespace oneac
