#include "suspension.h"

#include "random_numbers.h"

#include "oneac/geometry/angles.h"

#include <algorithm>
#include <cmath>

namespace oneac::simulation {
namespace {

constexpr double kStep_s = 0.005;                             // fine against the oscillation
constexpr double kFrequency = 2.0 * 3.141592653589793 * 1.3;  // [rad/s] bodies of cars: 1 to 1.5 Hz
constexpr double kDamping = 0.35;                             // of critical; usual dampers
constexpr double kDive = 0.15 * kDegree;  // [rad per m/s²] nose down when braking
constexpr double kLean = 0.15 * kDegree;  // [rad per m/s²] outwards when cornering
constexpr double kSettle_s = 3.0;         // run-in before the drive, so that it starts in motion

struct Oscillator {
  double angle = 0.0;
  double rate = 0.0;

  void step(double target) {  // semi-implicit Euler
    rate +=
        kStep_s * (kFrequency * kFrequency * (target - angle) - 2.0 * kDamping * kFrequency * rate);
    angle += kStep_s * rate;
  }
};

/// Std. deviation of white noise per step that makes the oscillator's angle vary by sigma:
/// variance = frequency * noise² * step / (4 damping).
double excitation(double sigma) {
  return sigma * std::sqrt(4.0 * kDamping / (kFrequency * kStep_s));
}

double between(double a, double b, double weight) {
  return a + (b - a) * weight;
}

}  // namespace

Suspension::Suspension(const SimulationOptions& options, const Route& route, double duration_s) {
  RandomNumbers random(options.seed ^ 0x737072696e67ULL);
  const double pitch_noise = excitation(options.suspension_pitch_deg * kDegree);
  const double roll_noise = excitation(options.suspension_roll_deg * kDegree);
  Oscillator pitch;
  Oscillator roll;
  const auto first = -static_cast<long>(kSettle_s / kStep_s);
  const auto last = static_cast<long>(duration_s / kStep_s) + 2;
  for (long i = first; i <= last; ++i) {
    const PlanarState state = route.at(std::max(0.0, static_cast<double>(i) * kStep_s));
    const double roughness = std::min(1.0, state.speed / options.speed_mps);
    const double cornering = state.curvature * state.speed * state.speed;
    pitch.step(roughness * pitch_noise * random.normal() - kDive * state.acceleration);
    roll.step(roughness * roll_noise * random.normal() + kLean * cornering);
    if (i >= 0) table_.push_back({pitch.angle, roll.angle, pitch.rate, roll.rate});
  }
}

BodyAttitude Suspension::at(double time_s) const {
  const double last_cell = static_cast<double>(table_.size()) - 2.0;
  const double position = std::clamp(time_s / kStep_s, 0.0, last_cell + 1.0);
  const auto cell = static_cast<std::size_t>(std::min(position, last_cell));
  const double weight = position - static_cast<double>(cell);
  const BodyAttitude& a = table_[cell];
  const BodyAttitude& b = table_[cell + 1];
  return {between(a.pitch, b.pitch, weight), between(a.roll, b.roll, weight),
          between(a.pitch_rate, b.pitch_rate, weight), between(a.roll_rate, b.roll_rate, weight)};
}

}  // namespace oneac::simulation
