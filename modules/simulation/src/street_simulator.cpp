#include "oneac/simulation/street_simulator.h"

#include "along_traffic.h"
#include "camera_mount.h"
#include "picture_effects.h"
#include "random_numbers.h"
#include "street_renderer.h"
#include "suspension.h"
#include "wheel_counter.h"

#include "oneac/geometry/angles.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace oneac {

using simulation::BodyAttitude;
using simulation::mix_bits;
using simulation::PlanarState;
using simulation::RandomNumbers;
using simulation::Route;
using simulation::StreetRenderer;
using simulation::Suspension;

namespace {

constexpr double kGravity = 9.80665;          // [m/s²]
constexpr double kGpsRate = 1.0;              // [Hz] Málaga's receiver
constexpr double kImuRate = 100.0;            // [Hz] Málaga's unit
constexpr double kWheelRate = 50.0;           // [Hz] of a CAN bus
constexpr double kGpsSpeedNoise = 0.05;       // [m/s] Doppler
constexpr double kGpsCourseNoise = 0.3;       // [deg]
constexpr double kAccelerometerNoise = 0.05;  // [m/s²]
constexpr float kDarkness = 0.02F;            // of the daylight: an unlit tunnel
constexpr double kGyroNoise = 0.002;          // [rad/s]

double duration(const SimulationOptions& options) {
  return (options.frames - 1) / options.fps;
}

Eigen::Matrix3d body_rotation(double heading, const BodyAttitude& body) {
  return (Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(body.pitch, Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(body.roll, Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

Eigen::Vector3d three_normals(RandomNumbers& random) {
  const double x = random.normal();
  const double y = random.normal();
  return {x, y, random.normal()};
}

Eigen::Isometry3d slope_of(const SimulationOptions& options) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  const double angle = std::atan(options.slope_percent / 100.0);
  T.linear() = Eigen::AngleAxisd(-angle, Eigen::Vector3d::UnitY()).toRotationMatrix();
  return T;
}

double course_deg(double heading) {
  const double course = std::fmod(90.0 - heading / kDegree, 360.0);
  return course < 0.0 ? course + 360.0 : course;
}

const SimulationOptions& checked(const SimulationOptions& options) {
  options.validate();
  return options;
}

}  // namespace

struct StreetSimulator::Impl {
  explicit Impl(const SimulationOptions& chosen)
      : options(checked(chosen)),
        camera(simulation::camera_of(options)),
        T_vehicle_cam(simulation::mount_of(options)),
        route(options, duration(options)),
        suspension(options, route, duration(options) + options.rolling_shutter_s),
        T_world_town(slope_of(options)),
        renderer(camera, route, options, simulation::traffic_of(options, route, duration(options)),
                 false),
        effects(options) {
    if (options.relight)
      relit.emplace(camera, route, options, std::vector<simulation::MovingVehicle>{}, true);
  }

  /// When the camera saw what an image shows [s].
  [[nodiscard]] double taken_at(std::size_t i) const;
  [[nodiscard]] SimulatedState state_at(double time_s) const;
  [[nodiscard]] GreyImage image(const SimulatedFrame& frame, int side) const;
  [[nodiscard]] std::vector<float> rendered(double time_s, int side) const;
  [[nodiscard]] const StreetRenderer& renderer_at(double time_s) const;
  [[nodiscard]] SimulatedGps gps_at(double time_s, RandomNumbers& random) const;
  [[nodiscard]] SimulatedImu imu_at(double time_s, RandomNumbers& random) const;

  SimulationOptions options;
  PinholeCamera camera;
  Eigen::Isometry3d T_vehicle_cam;
  Route route;
  Suspension suspension;
  Eigen::Isometry3d
      T_world_town;  ///< the town is built on the plane Z = 0 and then put on its slope
  StreetRenderer renderer;
  std::optional<StreetRenderer> relit;  ///< of every second lap
  simulation::PictureEffects effects;
};

double StreetSimulator::Impl::taken_at(std::size_t i) const {
  if (options.repeat_every == 0) return static_cast<double>(i) / options.fps;
  const auto every = static_cast<std::size_t>(options.repeat_every);
  const std::size_t taken = i - (i + 1) / every;
  const double camera_fps = options.fps * (1.0 - 1.0 / static_cast<double>(every));
  return static_cast<double>(taken) / camera_fps;
}

SimulatedState StreetSimulator::Impl::state_at(double time_s) const {
  const PlanarState planar = route.at(time_s);
  SimulatedState state;
  state.time_s = time_s;
  state.T_world_vehicle.linear() = body_rotation(planar.heading, suspension.at(time_s));
  state.T_world_vehicle.translation() << planar.position, 0.0;
  state.T_world_vehicle = T_world_town * state.T_world_vehicle;
  state.T_world_cam = state.T_world_vehicle * T_vehicle_cam;
  state.speed_mps = planar.speed;
  state.yaw_rate_radps = planar.curvature * planar.speed;
  return state;
}

const StreetRenderer& StreetSimulator::Impl::renderer_at(double time_s) const {
  return relit && route.lap_at(time_s) % 2 == 1 ? *relit : renderer;
}

std::vector<float> StreetSimulator::Impl::rendered(double time_s, int side) const {
  const Eigen::Translation3d to_the_right(side * options.baseline_m, 0.0, 0.0);
  const auto T_town_cam = [this, &to_the_right, side](double t) -> Eigen::Isometry3d {
    const Eigen::Isometry3d T_world_left = state_at(t).T_world_cam;
    return T_world_town.inverse() * (side == 0 ? T_world_left : T_world_left * to_the_right);
  };
  const StreetRenderer& town = renderer_at(time_s);
  if (options.rolling_shutter_s == 0.0) return town.render(T_town_cam(time_s), time_s);
  return town.render_rolling(T_town_cam, time_s, options.rolling_shutter_s);
}

/// @param side  0: left, 1: right
GreyImage StreetSimulator::Impl::image(const SimulatedFrame& frame, int side) const {
  const std::uint64_t key = mix_bits(options.seed) + 2 * static_cast<std::uint64_t>(frame.index) +
                            static_cast<std::uint64_t>(side);
  const double time_s = taken_at(frame.index);
  std::vector<float> grey = rendered(time_s, side);
  effects.apply(grey, time_s, side);
  if (time_s >= options.dark_from_s && time_s < options.dark_from_s + options.dark_s) {
    for (float& value : grey) value *= kDarkness;
  }
  return simulation::expose(grey, camera.width, camera.height, effects.noise(), key);
}

SimulatedGps StreetSimulator::Impl::gps_at(double time_s, RandomNumbers& random) const {
  const PlanarState planar = route.at(time_s);
  SimulatedGps fix;
  fix.time_s = time_s;
  fix.position_m << planar.position, 0.0;
  fix.position_m = T_world_town * fix.position_m;
  fix.position_m += options.gps_noise_m * three_normals(random);
  fix.speed_mps = std::abs(planar.speed + kGpsSpeedNoise * random.normal());
  fix.course_deg = course_deg(planar.heading + kGpsCourseNoise * kDegree * random.normal());
  return fix;
}

SimulatedImu StreetSimulator::Impl::imu_at(double time_s, RandomNumbers& random) const {
  const PlanarState planar = route.at(time_s);
  const BodyAttitude body = suspension.at(time_s);
  const Eigen::Matrix3d R_level_body = body_rotation(0.0, body);
  const double cornering = planar.curvature * planar.speed * planar.speed;
  const Eigen::Vector3d up = T_world_town.linear().transpose() * Eigen::Vector3d::UnitZ();
  const Eigen::Matrix3d R_town_heading = body_rotation(planar.heading, {});
  const Eigen::Vector3d force = Eigen::Vector3d(planar.acceleration, cornering, 0.0) +
                                kGravity * (R_town_heading.transpose() * up);
  const Eigen::Vector3d yaw(0.0, 0.0, planar.curvature * planar.speed);
  SimulatedImu reading;
  reading.time_s = time_s;
  reading.specific_force_mps2 = R_level_body.transpose() * force;
  // Pitch and roll are below a degree: their rates add to first order.
  reading.angular_rate_radps =
      R_level_body.transpose() * yaw + Eigen::Vector3d(body.roll_rate, body.pitch_rate, 0.0);
  reading.specific_force_mps2 += kAccelerometerNoise * three_normals(random);
  reading.angular_rate_radps += kGyroNoise * three_normals(random);
  return reading;
}

StreetSimulator::StreetSimulator(const SimulationOptions& options)
    : impl_(std::make_unique<const Impl>(options)) {}
StreetSimulator::~StreetSimulator() = default;
StreetSimulator::StreetSimulator(StreetSimulator&&) noexcept = default;
StreetSimulator& StreetSimulator::operator=(StreetSimulator&&) noexcept = default;

const SimulationOptions& StreetSimulator::options() const {
  return impl_->options;
}
std::size_t StreetSimulator::size() const {
  return static_cast<std::size_t>(impl_->options.frames);
}
PinholeCamera StreetSimulator::camera() const {
  return impl_->camera;
}
Eigen::Isometry3d StreetSimulator::T_vehicle_cam() const {
  return impl_->T_vehicle_cam;
}

SimulatedState StreetSimulator::state(std::size_t i) const {
  if (i >= size()) {
    throw std::out_of_range("StreetSimulator: frame " + std::to_string(i) + " of " +
                            std::to_string(size()));
  }
  SimulatedState state = impl_->state_at(impl_->taken_at(i));
  state.time_s = static_cast<double>(i) / impl_->options.fps;
  return state;
}

SimulatedFrame StreetSimulator::frame(std::size_t i) const {
  SimulatedFrame frame;
  frame.index = i;
  frame.state = state(i);
  frame.left = impl_->image(frame, 0);
  if (impl_->options.stereo) frame.right = impl_->image(frame, 1);
  return frame;
}

GreyImage StreetSimulator::render(const Eigen::Isometry3d& T_world_cam) const {
  const PinholeCamera& camera = impl_->camera;
  return simulation::expose(
      impl_->renderer.render(impl_->T_world_town.inverse() * T_world_cam, 0.0), camera.width,
      camera.height, 0.0, 0);
}

std::optional<Eigen::Vector3d> StreetSimulator::surface_point(const Eigen::Isometry3d& T_world_cam,
                                                              const Eigen::Vector2d& u_px) const {
  const auto X =
      impl_->renderer.surface_point(impl_->T_world_town.inverse() * T_world_cam, u_px, 0.0);
  if (!X) return std::nullopt;
  return impl_->T_world_town * *X;
}

std::vector<SimulatedGps> StreetSimulator::gps() const {
  RandomNumbers random(impl_->options.seed ^ 0x677073ULL);
  std::vector<SimulatedGps> fixes;
  const auto last = static_cast<int>(std::ceil(duration(impl_->options) * kGpsRate - 1e-9));
  for (int i = 0; i <= last; ++i) fixes.push_back(impl_->gps_at(i / kGpsRate, random));
  return fixes;
}

std::vector<SimulatedImu> StreetSimulator::imu() const {
  RandomNumbers random(impl_->options.seed ^ 0x696d75ULL);
  std::vector<SimulatedImu> readings;
  const auto last = static_cast<int>(duration(impl_->options) * kImuRate + 1e-9);
  for (int i = 0; i <= last; ++i) readings.push_back(impl_->imu_at(i / kImuRate, random));
  return readings;
}

std::vector<SimulatedWheels> StreetSimulator::wheels() const {
  std::vector<SimulatedWheels> readings;
  simulation::WheelCounter counter(1.0 + impl_->options.wheel_error_percent / 100.0);
  const auto last = static_cast<int>(duration(impl_->options) * kWheelRate + 1e-9);
  const double start = impl_->route.at(0.0).heading;
  for (int i = 0; i <= last; ++i) {
    const double time_s = i / kWheelRate;
    counter.add(impl_->route.at(time_s), 1.0 / kWheelRate);
    readings.push_back({time_s, counter.position(start), counter.heading() - start});
  }
  return readings;
}

}  // namespace oneac
