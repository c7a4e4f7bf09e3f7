#include "simulate_flags.h"

#include "oneac/simulation/hard_drives.h"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <string_view>

namespace oneac::app {
namespace {

template <class Kind>
void add_kind(CLI::App& verb, const char* flag, Kind& value, const char* help,
              const std::map<std::string, Kind>& names) {
  verb.add_option(flag, value, help)->transform(CLI::CheckedTransformer(names));
}

void add_hard(CLI::App& verb, SimulationOptions& options) {
  CLI::IsMember names([] {
    std::vector<std::string> all;
    for (const HardDrive& drive : hard_drives()) all.push_back(drive.name);
    return all;
  }());
  verb.add_option_function<std::string>(
          "--hard", [&options](const std::string& name) { options = hard_drive(name).options; },
          "A kind of drive that is hard (docs/benchmarks/hard-drives.md); other flags change it")
      ->check(names)
      ->trigger_on_parse();
}

void add_camera_flags(CLI::App& verb, SimulationOptions& options) {
  verb.add_option("--width", options.width_px, "[px]")->capture_default_str();
  verb.add_option("--height", options.height_px, "[px]")->capture_default_str();
  verb.add_option("--focal", options.focal_px, "[px]")->capture_default_str();
  verb.add_option("--fps", options.fps, "[Hz]")->capture_default_str();
  verb.add_option("--tilt-deg", options.camera_tilt_deg, "Camera, upwards [deg]")
      ->capture_default_str();
  verb.add_option("--mount-roll", options.camera_roll_deg,
                  "Camera, right side down [deg]; 180: upside down")
      ->capture_default_str();
  verb.add_option("--mount-yaw", options.camera_yaw_deg, "Camera, to the left [deg]; 180: rear")
      ->capture_default_str();
  verb.add_option("--camera-height", options.camera_height_m, "Above the road [m]")
      ->capture_default_str();
  verb.add_option("--noise", options.image_noise, "Std. deviation [grey levels]")
      ->capture_default_str();
  verb.add_flag("--stereo", options.stereo, "Write stereo observations");
  verb.add_option("--baseline", options.baseline_m, "Of the stereo pair [m]")
      ->capture_default_str();
}

void add_picture_flags(CLI::App& verb, SimulationOptions& options) {
  verb.add_option("--bonnet", options.bonnet_share,
                  "Share of the picture's height that a bonnet hides; 0: none")
      ->capture_default_str();
  verb.add_flag("--rain", options.rain, "Drops on the windscreen");
  verb.add_flag("--wiper", options.wiper, "A wiper sweeps the picture");
  verb.add_flag("--exposure-jumps", options.exposure_jumps, "Another exposure every 1.1 s");
  verb.add_flag("--night", options.night, "Headlights, noise, hot pixels");
  verb.add_option("--repeat-every", options.repeat_every,
                  "Every so many-th image shows the one before once more; 0: never")
      ->capture_default_str();
  verb.add_option("--rolling-shutter", options.rolling_shutter_s,
                  "From the first row to the last [s]; the pose is that of the first")
      ->capture_default_str();
  verb.add_option("--dark-from", options.dark_from_s, "Nearly black images from here on [s] ...")
      ->capture_default_str();
  verb.add_option("--dark", options.dark_s, "... for so long [s]; 0: never")->capture_default_str();
}

void add_drive_flags(CLI::App& verb, SimulationOptions& options) {
  verb.add_option("--frames", options.frames, "Number of images")->capture_default_str();
  verb.add_option("--seed", options.seed, "Everything random follows from it")
      ->capture_default_str();
  verb.add_option("--speed", options.speed_mps, "On straights [m/s]")->capture_default_str();
  verb.add_option("--stop", options.stop_s, "Standing on every second street [s]; 0: none")
      ->capture_default_str();
  verb.add_option("--suspension-pitch", options.suspension_pitch_deg, "Std. deviation [deg]")
      ->capture_default_str();
  verb.add_option("--suspension-roll", options.suspension_roll_deg, "Std. deviation [deg]")
      ->capture_default_str();
  verb.add_option("--slope", options.slope_percent, "Of the whole town, along the first street [%]")
      ->capture_default_str();
  verb.add_option("--gps-noise", options.gps_noise_m, "Std. deviation per axis [m]")
      ->capture_default_str();
  verb.add_option("--wheel-error", options.wheel_error_percent,
                  "By which --odometry counts too long a way [%]")
      ->capture_default_str();
}

void add_scene_flags(CLI::App& verb, SimulationOptions& options) {
  add_kind<RouteKind>(verb, "--route", options.route, "Where the vehicle drives",
                      {{"street", RouteKind::kStreet},
                       {"straight", RouteKind::kStraight},
                       {"stop-and-go", RouteKind::kStopAndGo},
                       {"roundabout", RouteKind::kRoundabout},
                       {"block", RouteKind::kBlock},
                       {"figure8", RouteKind::kFigure8}});
  verb.add_option("--block-m", options.block_m, "Side of the block [m]")->capture_default_str();
  verb.add_option("--lane-shift-m", options.lane_shift_m,
                  "Every second lap of the block drives so far to the left [m]")
      ->capture_default_str();
  verb.add_flag("--relight", options.relight,
                "Every second lap of the block: another light, other parked vehicles");
  verb.add_flag("--alike", options.alike, "Every facade and every street looks like the first");
  add_kind<Scenery>(verb, "--scenery", options.scenery, "Facades, or clouds and far houses",
                    {{"town", Scenery::kTown}, {"far", Scenery::kFar}});
  add_kind<RoadSurface>(verb, "--road", options.road, "What the road shows",
                        {{"textured", RoadSurface::kTextured},
                         {"dark", RoadSurface::kDark},
                         {"dashes", RoadSurface::kDashes},
                         {"slabs", RoadSurface::kSlabs},
                         {"wet", RoadSurface::kWet}});
  add_kind<Traffic>(verb, "--traffic", options.traffic,
                    "What moves; overtaking, oncoming and truck on straight and stop-and-go only",
                    {{"none", Traffic::kNone},
                     {"crossing", Traffic::kCrossing},
                     {"overtaking", Traffic::kOvertaking},
                     {"oncoming", Traffic::kOncoming},
                     {"truck", Traffic::kTruck},
                     {"bus", Traffic::kBus}});
  verb.add_flag_callback(
      "--crossing-traffic", [&options] { options.traffic = Traffic::kCrossing; },
      "The same as --traffic crossing");
  verb.add_option("--truck-gap", options.truck_gap_m, "From the camera to the truck [m]")
      ->capture_default_str();
  verb.add_option("--truck-gap-swing", options.truck_gap_swing_m,
                  "By how much it swings in 12 s [m]; 0: constant")
      ->capture_default_str();
}

struct NamedFlag {
  const char *field, *flag;
};
/// Of SimulationOptions; those that no flag sets are left out.
constexpr std::array<NamedFlag, 29> kFlags{{{"frames", "--frames"},
                                            {"width_px", "--width"},
                                            {"height_px", "--height"},
                                            {"focal_px", "--focal"},
                                            {"fps", "--fps"},
                                            {"baseline_m", "--baseline"},
                                            {"image_noise", "--noise"},
                                            {"camera_height_m", "--camera-height"},
                                            {"camera_tilt_deg", "--tilt-deg"},
                                            {"camera_roll_deg", "--mount-roll"},
                                            {"camera_yaw_deg", "--mount-yaw"},
                                            {"speed_mps", "--speed"},
                                            {"stop_s", "--stop"},
                                            {"suspension_pitch_deg", "--suspension-pitch"},
                                            {"suspension_roll_deg", "--suspension-roll"},
                                            {"slope_percent", "--slope"},
                                            {"dark_from_s", "--dark-from"},
                                            {"dark_s", "--dark"},
                                            {"gps_noise_m", "--gps-noise"},
                                            {"wheel_error_percent", "--wheel-error"},
                                            {"truck_gap_m", "--truck-gap"},
                                            {"truck_gap_swing_m", "--truck-gap-swing"},
                                            {"bonnet_share", "--bonnet"},
                                            {"rolling_shutter_s", "--rolling-shutter"},
                                            {"traffic", "--traffic"},
                                            {"route", "--route"},
                                            {"block_m", "--block-m"},
                                            {"lane_shift_m", "--lane-shift-m"},
                                            {"relight", "--relight"}}};

}  // namespace

std::string in_words_of_flags(const std::string& fault) {
  constexpr std::string_view kStruct = "SimulationOptions.";
  if (fault.compare(0, kStruct.size(), kStruct) != 0) return fault;
  const auto end = std::min(fault.find(' '), fault.size());
  const std::string field = fault.substr(kStruct.size(), end - kStruct.size());
  for (const NamedFlag& named : kFlags) {
    if (field == named.field) return named.flag + fault.substr(end);
  }
  return fault;
}

void add_simulation_flags(CLI::App& verb, SimulationOptions& options) {
  add_hard(verb, options);
  add_drive_flags(verb, options);
  add_scene_flags(verb, options);
  add_camera_flags(verb, options);
  add_picture_flags(verb, options);
}

}  // namespace oneac::app
