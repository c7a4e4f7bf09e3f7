#include "bonnet.h"

#include "random_numbers.h"

#include <cmath>

namespace oneac::simulation {
namespace {

constexpr double kDistance_m = 1.2;   // of the bonnet from the camera
constexpr double kDroop = 0.3;        // of its share: how far the edge falls towards the wings
constexpr double kCompression = 2.4;  // a curved mirror shows more of the scene than a flat one
constexpr double kSpread = 0.35;      // rays are turned aside on the wings
constexpr float kPaint = 48.0F;       // [grey levels] a dark car
constexpr float kReflectance = 0.4F;  // at this grazing angle
constexpr float kSoftness_px = 1.5F;  // out of focus
constexpr int kAtLeast = 4;           // [px] of a canvas

void paint_marks(RandomNumbers& random, Canvas& canvas) {
  const double w = canvas.width();
  const double h = canvas.height();
  canvas.dead_leaves(random, {1.2, 5.0, 0.02, 28.0, 0.1});  // dust, dried drops, chips
  for (const double side : {0.22, 0.78}) {                  // seams to the wings, washer nozzles
    canvas.rectangle({side * w, 0.12 * h}, {side * w + 2.5, h}, -38.0);
    canvas.ellipse({{(0.5 + 0.6 * (side - 0.5)) * w, 0.8 * h}, {9.0, 4.0}, 0.0}, 55.0);
  }
  canvas.ellipse({{0.5 * w, 0.1 * h}, {11.0, 5.0}, 0.0}, 90.0);  // badge
  canvas.rectangle({0.3 * w, 0.92 * h}, {0.7 * w, 0.96 * h}, -40.0);
}

}  // namespace

Bonnet::Bonnet(const SimulationOptions& options)
    : width_(options.width_px),
      height_(options.height_px),
      share_(options.bonnet_share),
      disparity_px_(options.focal_px * options.baseline_m / kDistance_m),
      marks_(width_, std::max(kAtLeast, static_cast<int>(share_ * height_)), 0.0F) {
  RandomNumbers random(options.seed ^ 0x626f6e6e6574ULL);
  paint_marks(random, marks_);
}

double Bonnet::edge(double u) const {
  const double x = 2.0 * u / width_ - 1.0;
  return height_ * (1.0 - share_ * (1.0 - kDroop * x * x));
}

float Bonnet::surface(const Picture& picture, double u, double v) const {
  const double below = v - edge(u);
  const double x = 2.0 * u / width_ - 1.0;
  const double source_u = u + kSpread * x * below;
  const double source_v = edge(u) - kCompression * below - 1.0;
  float reflected = 0.0F;
  for (int k = -2; k <= 2; ++k) {
    reflected +=
        picture.near(source_u + 1.5 * k, source_v + k) + picture.near(source_u - k, source_v);
  }
  const int row = static_cast<int>(v - (height_ - marks_.height()));
  const float mark = marks_.at(static_cast<int>(u), std::clamp(row, 0, marks_.height() - 1));
  return kPaint + kReflectance * 0.1F * reflected + mark;
}

void Bonnet::draw(const Picture& picture, int side) const {
  if (share_ == 0.0) return;
  const double shift = side * disparity_px_;
  const int first = static_cast<int>(height_ * (1.0 - share_)) - 2;
  // From below: reflections are read above the edge, where nothing has been drawn yet.
  for (int v = height_ - 1; v >= std::max(0, first); --v) {
    for (int u = 0; u < width_; ++u) {
      const double on_bonnet = std::clamp(u + shift, 0.0, width_ - 1.0);
      const auto depth = static_cast<float>(v - edge(on_bonnet));
      const float covered = std::clamp(0.5F + depth / kSoftness_px, 0.0F, 1.0F);
      if (covered == 0.0F) continue;
      float& grey = picture.at(u, v);
      grey += covered * (surface(picture, on_bonnet, v) - grey);
    }
  }
}

}  // namespace oneac::simulation
