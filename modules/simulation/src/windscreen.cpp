#include "windscreen.h"

#include "random_numbers.h"

#include <cmath>

namespace oneac::simulation {
namespace {

constexpr double kPi = 3.141592653589793;
constexpr double kCycle_s = 1.6;     // of a wiper at its first speed
constexpr double kSweep_s = 0.9;     // up and down again
constexpr double kReach = 1.2;       // [picture heights] of the blade
constexpr double kPivotU = 0.35;     // [picture widths]
constexpr double kPivotV = 1.12;     // [picture heights]
constexpr double kFrom = 0.15;       // [rad] from the right, where the blade is parked
constexpr double kTurn = 2.2;        // [rad] of its sweep
constexpr double kBlade = 0.012;     // [picture widths] half of its width: out of focus
constexpr int kSweptDrops = 160;     // steady rain
constexpr int kLastingDrops = 30;    // with a wiper: beyond its reach
constexpr int kUnwipedDrops = 110;   // without
constexpr double kLasting_s = 9.0;   // until a drop runs off or merges
constexpr double kSmallest = 0.006;  // [picture widths] radius
constexpr double kLargest = 0.024;
constexpr double kLens = 5.0;   // a drop shows so much more than it covers, upside down
constexpr float kVeil = 0.25F;  // share of the contrast that the wet air takes
constexpr float kVeilGrey = 150.0F;

/// Since the start of the cycle, when the blade passes a share of its sweep upwards [s].
double passes_at(double share) {
  return kSweep_s / kPi * std::asin(std::sqrt(share));
}

RandomNumbers numbers_of(std::uint64_t seed, int k, long cycle, int side) {
  const auto place = static_cast<std::uint64_t>(4 * k + side);
  return RandomNumbers(mix_bits(seed ^ 0x7261696eULL) + (place << 32U) +
                       static_cast<std::uint64_t>(cycle));
}

}  // namespace

Windscreen::Windscreen(const SimulationOptions& options)
    : width_(options.width_px),
      height_(options.height_px),
      rain_(options.rain),
      wiper_(options.wiper),
      seed_(options.seed) {}

void Windscreen::draw(const Picture& picture, double time_s, int side) const {
  if (rain_) {
    fade(picture);
    draw_drops(picture, time_s, side);
  }
  if (wiper_) draw_blade(picture, time_s);
}

void Windscreen::fade(const Picture& picture) const {
  for (float& value : picture.grey) value += kVeil * (kVeilGrey - value);
}

std::optional<Windscreen::Drop> Windscreen::swept_drop(int k, double time_s, int side) const {
  const double share = (k + 0.5) / kSweptDrops;
  const double upwards = passes_at(share);
  const double gone = kSweep_s - upwards;  // the blade has passed downwards, too
  const auto cycle = static_cast<long>(std::floor((time_s - upwards) / kCycle_s));
  const double since_s = time_s - static_cast<double>(cycle) * kCycle_s;
  RandomNumbers random = numbers_of(seed_, k, cycle, side);
  const double born_s = random.uniform(gone, 0.8 * kCycle_s + upwards);
  if (since_s < born_s) return std::nullopt;
  const double angle = kFrom + share * kTurn + random.uniform(-0.02, 0.02);
  const double reach = random.uniform(0.2, kReach) * height_;
  const double u = kPivotU * width_ + reach * std::cos(angle);
  const double v = kPivotV * height_ - reach * std::sin(angle);
  return Drop{u, v, random.uniform(kSmallest, kLargest) * width_};
}

std::optional<Windscreen::Drop> Windscreen::lasting_drop(int k, double time_s, int side) const {
  const double phase = numbers_of(seed_, kSweptDrops + k, -1, side).uniform(0.0, kLasting_s);
  const auto cycle = static_cast<long>(std::floor((time_s + phase) / kLasting_s));
  RandomNumbers random = numbers_of(seed_, kSweptDrops + k, cycle, side);
  const double u = random.uniform(0.0, width_);
  const double v = random.uniform(0.0, height_);
  const double radius = random.uniform(kSmallest, kLargest) * width_;
  const double reach = std::hypot(u - kPivotU * width_, v - kPivotV * height_);
  if (wiper_ && reach < kReach * height_) return std::nullopt;
  return Drop{u, v, radius};
}

void Windscreen::draw_drops(const Picture& picture, double time_s, int side) const {
  std::vector<std::optional<Drop>> drops;
  for (int k = 0; wiper_ && k < kSweptDrops; ++k) drops.push_back(swept_drop(k, time_s, side));
  const int lasting = wiper_ ? 6 * kLastingDrops : kUnwipedDrops;  // most fall in the blade's reach
  for (int k = 0; k < lasting; ++k) drops.push_back(lasting_drop(k, time_s, side));
  std::vector<float> behind = picture.grey;
  const Picture scene{behind, width_, height_};
  for (const std::optional<Drop>& drop : drops) {
    if (!drop) continue;
    const int reach = static_cast<int>(drop->radius) + 1;
    for (int dv = -reach; dv <= reach; ++dv) {
      for (int du = -reach; du <= reach; ++du) {
        const int u = static_cast<int>(drop->u) + du;
        const int v = static_cast<int>(drop->v) + dv;
        if (u < 0 || v < 0 || u >= width_ || v >= height_) continue;
        const double r = std::hypot(du, 0.8 * dv) / drop->radius;  // higher than wide
        if (r >= 1.0) continue;
        const float seen = scene.near(u - kLens * du, v - kLens * dv);
        const auto rim = static_cast<float>(1.0 - 0.6 * r * r * r * r);
        const auto covered = static_cast<float>(std::min(1.0, 3.0 * (1.0 - r)));
        picture.at(u, v) += 0.85F * covered * (rim * seen - picture.at(u, v));
      }
    }
  }
}

void Windscreen::draw_blade(const Picture& picture, double time_s) const {
  const double phase = std::fmod(time_s, kCycle_s);
  if (phase >= kSweep_s) return;
  const double swing = std::sin(kPi * phase / kSweep_s);
  const double angle = kFrom + kTurn * swing * swing;
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const double half = kBlade * width_;
  for (int v = 0; v < height_; ++v) {
    for (int u = 0; u < width_; ++u) {
      const double du = u - kPivotU * width_;
      const double dv = kPivotV * height_ - v;
      const double along = c * du + s * dv;
      if (along < 0.0 || along > kReach * height_) continue;
      const double beside = std::abs(c * dv - s * du);
      const auto covered = static_cast<float>(std::clamp(2.0 - beside / half, 0.0, 1.0));
      picture.at(u, v) += covered * (15.0F - picture.at(u, v));
    }
  }
}

}  // namespace oneac::simulation
