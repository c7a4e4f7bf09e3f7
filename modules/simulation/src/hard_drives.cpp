#include "oneac/simulation/hard_drives.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace oneac {
namespace {

using Change = void (*)(SimulationOptions&);

HardDrive kind(const char* name, const char* what, Change change) {
  HardDrive drive{name, what, {}};
  drive.options.frames = 100;
  drive.options.width_px = 512;
  drive.options.height_px = 384;
  drive.options.focal_px = 400.0;
  drive.options.stop_s = 0.0;
  change(drive.options);
  drive.options.validate();
  return drive;
}

void highway(SimulationOptions& o) {
  o.route = RouteKind::kStraight;
  o.scenery = Scenery::kFar;
  o.speed_mps = 12.0;  // 1.2 m between frames
}

void open_land(SimulationOptions& o) {
  o.scenery = Scenery::kFar;
  o.road = RoadSurface::kDark;
  o.speed_mps = 4.0;
}

void straight_town(SimulationOptions& o) {
  o.route = RouteKind::kStraight;
}

std::vector<HardDrive> drives_of_the_road() {
  return {
      kind("far", "overcast open land, dark road, a stop: far points outnumber near ones",
           [](SimulationOptions& o) {
             open_land(o), o.route = RouteKind::kStraight, o.stop_s = 3.0, o.frames = 160;
           }),
      kind("dashes", "highway of smooth asphalt: dashes and nothing else",
           [](SimulationOptions& o) { highway(o), o.road = RoadSurface::kDashes; }),
      kind("stop-and-go", "a queue: some metres, a stop, some metres",
           [](SimulationOptions& o) {
             o.route = RouteKind::kStopAndGo, o.speed_mps = 4.0, o.frames = 160;
           }),
      kind("roundabout", "clouds and far houses while turning, dark road",
           [](SimulationOptions& o) {
             open_land(o), o.route = RouteKind::kRoundabout, o.speed_mps = 6.0, o.frames = 160;
           }),
  };
}

std::vector<HardDrive> drives_among_traffic() {
  return {
      kind("overtaking", "vehicles pass on the left lane",
           [](SimulationOptions& o) { straight_town(o), o.traffic = Traffic::kOvertaking; }),
      kind("oncoming", "vehicles come towards the camera",
           [](SimulationOptions& o) { straight_town(o), o.traffic = Traffic::kOncoming; }),
      kind("truck", "a lettered truck ahead at a constant gap, on a highway",
           [](SimulationOptions& o) {
             highway(o), o.road = RoadSurface::kDark, o.traffic = Traffic::kTruck;
           }),
      kind("truck-swing", "the same, the gap changes by up to 1.5 m",
           [](SimulationOptions& o) {
             highway(o), o.road = RoadSurface::kDark, o.traffic = Traffic::kTruck;
             o.truck_gap_swing_m = 1.5;
           }),
      kind("queue", "a truck ahead, stop and go, in town",
           [](SimulationOptions& o) {
             o.route = RouteKind::kStopAndGo, o.traffic = Traffic::kTruck, o.truck_gap_m = 5.0;
             o.speed_mps = 4.0;
           }),
      kind("bus", "buses fill the picture while the car stands",
           [](SimulationOptions& o) {
             straight_town(o), o.traffic = Traffic::kBus, o.speed_mps = 6.0, o.stop_s = 10.0;
             o.frames = 190;
           }),
      kind("red-light", "a stop while others roll past",
           [](SimulationOptions& o) {
             straight_town(o), o.traffic = Traffic::kOvertaking, o.speed_mps = 6.0, o.stop_s = 4.0;
             o.frames = 140;
           }),
  };
}

std::vector<HardDrive> drives_behind_glass() {
  return {
      kind("bonnet", "a highway above a bonnet with dust and reflections",
           [](SimulationOptions& o) {
             highway(o), o.road = RoadSurface::kDark, o.bonnet_share = 0.25;
           }),
      kind("rain", "drops on the windscreen and a wiper",
           [](SimulationOptions& o) { o.rain = o.wiper = true; }),
      kind("exposure", "the exposure jumps", [](SimulationOptions& o) { o.exposure_jumps = true; }),
      kind("night", "headlights, noise, hot pixels", [](SimulationOptions& o) { o.night = true; }),
      kind("rolling-shutter", "30 ms from the first row to the last",
           [](SimulationOptions& o) { o.rolling_shutter_s = 0.03; }),
  };
}

std::vector<HardDrive> drives_of_other_cameras() {
  return {
      kind("rear", "the camera looks back",
           [](SimulationOptions& o) { o.camera_yaw_deg = 180.0, o.camera_forward_m = -1.0; }),
      kind("left", "the camera looks to the left",
           [](SimulationOptions& o) { o.camera_yaw_deg = 90.0, o.camera_left_m = 0.8; }),
      kind("right", "the camera looks to the right",
           [](SimulationOptions& o) { o.camera_yaw_deg = -90.0, o.camera_left_m = -0.8; }),
      kind("upside-down", "the camera hangs upside down",
           [](SimulationOptions& o) { o.camera_roll_deg = 180.0; }),
      kind("portrait", "the camera is turned by a quarter",
           [](SimulationOptions& o) {
             o.camera_roll_deg = 90.0, o.width_px = 384, o.height_px = 512;
           }),
  };
}

}  // namespace

const std::vector<HardDrive>& hard_drives() {
  static const std::vector<HardDrive> drives = [] {
    std::vector<HardDrive> all;
    for (std::vector<HardDrive> part : {drives_behind_glass(), drives_of_the_road(),
                                        drives_among_traffic(), drives_of_other_cameras()}) {
      for (HardDrive& drive : part) all.push_back(std::move(drive));
    }
    return all;
  }();
  return drives;
}

const HardDrive& hard_drive(const std::string& name) {
  std::string known;
  for (const HardDrive& drive : hard_drives()) {
    if (drive.name == name) return drive;
    known += (known.empty() ? "" : ", ") + drive.name;
  }
  throw std::invalid_argument("hard_drive = " + name + ", must be one of " + known);
}

}  // namespace oneac
