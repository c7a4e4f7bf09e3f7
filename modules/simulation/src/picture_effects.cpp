#include "picture_effects.h"

#include "random_numbers.h"

#include <algorithm>
#include <cmath>

namespace oneac::simulation {
namespace {

constexpr double kJumpEvery_s = 1.1;
constexpr double kDarkestStop = -1.5;   // [stops] a third of the light
constexpr double kBrightestStop = 0.9;  // [stops] the sky and white paint burn out
constexpr float kAmbient = 0.07F;       // of the daylight: street lights far away
constexpr float kHeadlights = 0.75F;    // the same in the middle of the beam
constexpr double kBeamU = 0.36;         // [picture widths] std. deviation of the beam
constexpr double kBeamV = 0.20;         // [picture heights]
constexpr double kBeamBelow = 0.15;     // [picture heights] under the middle of the picture
constexpr double kNightNoise = 9.0;     // [grey levels] at the gain that a night takes
constexpr double kHotPixels = 3e-4;     // share of them
constexpr double kHottest = 130.0;      // [grey levels]

}  // namespace

PictureEffects::PictureEffects(const SimulationOptions& options)
    : options_(options), bonnet_(options), windscreen_(options) {}

double PictureEffects::noise() const {
  return options_.night ? std::max(options_.image_noise, kNightNoise) : options_.image_noise;
}

double PictureEffects::gain(double time_s) const {
  const auto period = static_cast<std::uint64_t>(std::max(0.0, time_s) / kJumpEvery_s);
  if (!options_.exposure_jumps || period == 0) return 1.0;
  RandomNumbers random(mix_bits(options_.seed ^ 0x657870ULL) + period);
  return std::exp2(random.uniform(kDarkestStop, kBrightestStop));
}

/// Headlights turn with the vehicle, and so stand still in the picture; hot pixels, too.
void PictureEffects::darken(const Picture& picture, int side) const {
  for (int v = 0; v < picture.height; ++v) {
    const double y = (static_cast<double>(v) / picture.height - 0.5 - kBeamBelow) / kBeamV;
    for (int u = 0; u < picture.width; ++u) {
      const double x = (static_cast<double>(u) / picture.width - 0.5) / kBeamU;
      const auto beam = static_cast<float>(std::exp(-0.5 * (x * x + y * y)));
      picture.at(u, v) *= kAmbient + kHeadlights * beam;
    }
  }
  RandomNumbers random(options_.seed ^ (0x686f74ULL + static_cast<std::uint64_t>(side)));
  for (int n = static_cast<int>(kHotPixels * picture.width * picture.height); n > 0; --n) {
    const int u = random.integer(0, picture.width - 1);
    const int v = random.integer(0, picture.height - 1);
    picture.at(u, v) += static_cast<float>(random.uniform(20.0, kHottest));
  }
}

void PictureEffects::apply(std::vector<float>& grey, double time_s, int side) const {
  const Picture picture{grey, options_.width_px, options_.height_px};
  bonnet_.draw(picture, side);
  windscreen_.draw(picture, time_s, side);
  if (options_.night) darken(picture, side);
  if (!options_.exposure_jumps) return;
  const auto factor = static_cast<float>(gain(time_s));
  for (float& value : grey) value *= factor;
}

}  // namespace oneac::simulation
