#include "road_painter.h"

#include "street_layout.h"

#include <algorithm>
#include <cmath>

namespace oneac::simulation {
namespace {

constexpr double kAsphaltTexel = 0.0125;  // [m] about a pixel at the nearest road seen
constexpr int kAsphaltSide = 2048;
constexpr double kToneTexel = 0.036;  // [m]
constexpr int kToneSide = 1024;
constexpr double kDecalTexel = 0.03;  // [m]
constexpr double kPaint = 60.0;       // white paint against asphalt, worn
constexpr double kLine = 0.14;        // [m] width of a marking

/// Rectangles and discs in the leg's frame [m]. Written with braces, which fix the order in which
/// random numbers are drawn.
struct Mark {
  double x;
  double y;
  double length;
  double width;
  double difference;
};
struct Disc {
  double x;
  double y;
  double radius;
  double difference;
};

/// Paints in the leg's frame.
class DecalCanvas {
 public:
  DecalCanvas(const Eigen::Vector2d& low, const Eigen::Vector2d& high)
      : low_(low),
        canvas_(static_cast<int>((high.x() - low.x()) / kDecalTexel),
                static_cast<int>((high.y() - low.y()) / kDecalTexel),
                static_cast<float>(kNeutral)) {}

  void rectangle(const Mark& mark) {
    const Eigen::Vector2d from = texel(mark.x, mark.y);
    const Eigen::Vector2d size(mark.length / kDecalTexel, mark.width / kDecalTexel);
    canvas_.rectangle(from, from + size, kNeutral + mark.difference, 0.9);
  }
  void disc(const Disc& disc) {
    const double r = disc.radius / kDecalTexel;
    canvas_.ellipse({texel(disc.x, disc.y), {r, r}, 0.0}, kNeutral + disc.difference);
  }
  [[nodiscard]] Canvas& texels() { return canvas_; }

 private:
  [[nodiscard]] Eigen::Vector2d texel(double x, double y) const {
    return (Eigen::Vector2d(x, y) - low_) / kDecalTexel;
  }

  Eigen::Vector2d low_;
  Canvas canvas_;
};

void paint_lines(DecalCanvas& road, double length, double paint) {
  road.rectangle({0.0, CrossSection::kRightEdge, length, kLine, paint});
  road.rectangle({0.0, CrossSection::kLeftEdge - kLine, length, kLine, paint});
  constexpr double kDash = 2.0;
  constexpr double kGap = 3.0;
  double x = 0.0;
  while (x < length - kDash) {
    road.rectangle({x, CrossSection::kCentreLine, kDash, kLine, paint});
    x += kDash + kGap;
  }
}

void paint_zebra(RandomNumbers& random, DecalCanvas& road, double x) {
  double y = CrossSection::kRightEdge + 0.4;
  while (y < CrossSection::kLeftEdge - 0.5) {
    road.rectangle({x, y, 3.0, 0.5, kPaint + 8.0 * random.normal()});
    y += 1.0;
  }
}

constexpr double kSlab = 0.6;  // [m]
constexpr double kJoint = 0.03;

void pave(RandomNumbers& random, DecalCanvas& road, double from_y, double to_y, double length) {
  double x = 0.0;
  while (x < length) {
    double y = from_y;
    while (y < to_y) {
      road.rectangle({x, y, kSlab - kJoint, kSlab - kJoint, 22.0 + 7.0 * random.normal()});
      y += kSlab;
    }
    x += kSlab;
  }
}

/// Joints of slabs that all look alike.
void paint_joints(DecalCanvas& road, double from_y, double to_y, double length) {
  constexpr double kDark = -40.0;
  const auto joints = [](double way) { return static_cast<int>(std::ceil(way / kSlab)); };
  for (int i = 0; i < joints(length); ++i) {
    road.rectangle({i * kSlab, from_y, kJoint, to_y - from_y, kDark});
  }
  for (int i = 0; i < joints(to_y - from_y); ++i) {
    road.rectangle({0.0, from_y + i * kSlab, length, kJoint, kDark});
  }
}

void repair(RandomNumbers& random, DecalCanvas& road, double length) {
  const auto along = [&] { return random.uniform(1.0, length - 3.0); };
  const auto across = [&] { return random.uniform(-2.4, 5.6); };
  for (int i = static_cast<int>(length / 3.0); i > 0; --i) {
    road.rectangle({along(), across(), random.uniform(0.3, 2.2), random.uniform(0.3, 1.2),
                    16.0 * random.normal()});
  }
  for (int i = static_cast<int>(length / 7.0); i > 0; --i) {
    const double x = along();
    const double y = across();
    road.disc({x, y, 0.36, 25.0});
    road.disc({x, y, 0.30, -35.0});
    for (int k = 0; k < 6; ++k) {
      road.disc({x + random.uniform(-0.2, 0.2), y + random.uniform(-0.2, 0.2), 0.05, 10.0});
    }
  }
  for (int i = static_cast<int>(length * 1.5); i > 0; --i) {  // oil, chewing gum, leaves
    road.disc(
        {along(), random.uniform(-6.0, 9.0), random.uniform(0.04, 0.2), 24.0 * random.normal()});
  }
  for (int i = static_cast<int>(length / 3.0); i > 0; --i) {
    road.texels().crack(random, random.integer(8, 40), 0.8, kNeutral - 35.0);
  }
}

}  // namespace

RoadLook road_look(RoadSurface road) {
  switch (road) {
    case RoadSurface::kDark:
      return {42.0F, 0.22, 0.25, true, false, false, false};
    case RoadSurface::kDashes:
      return {105.0F, 0.1, 1.0, false, false, false, false};
    case RoadSurface::kSlabs:
      return {105.0F, 0.1, 0.0, true, false, true, false};
    case RoadSurface::kWet:
      return {60.0F, 0.5, 0.6, true, true, false, true};
    default:
      return {105.0F, 1.0, 1.0, true, true, false, false};
  }
}

Texture paint_asphalt(const RoadLook& look, std::uint64_t seed) {
  RandomNumbers random(seed ^ 0x61737068616c74ULL);
  if (!look.grain) return {Canvas(16, 16, look.tone), kAsphaltTexel};
  Canvas canvas(kAsphaltSide, kAsphaltSide, look.tone);
  canvas.dead_leaves(random, {1.5, 200.0, 0.3, look.structure * 11.0, 0.05});
  const double crack = look.tone - look.structure * 45.0;
  for (int i = 0; i < 60; ++i) canvas.crack(random, random.integer(20, 80), 1.2, crack);
  // Stones, leaves, stains.
  canvas.dead_leaves(random, {1.5, 28.0, 0.06, look.structure * 27.0, 0.1});
  canvas.grain(random, look.structure * 5.0);
  return {canvas, kAsphaltTexel};
}

Texture paint_road_tone(const RoadLook& look, std::uint64_t seed) {
  RandomNumbers random(seed ^ 0x746f6e65ULL);
  Canvas canvas(kToneSide, kToneSide, static_cast<float>(kNeutral));
  canvas.dead_leaves(random, {2.0, 120.0, 0.3, look.structure * 8.0, 0.0});
  return {canvas, kToneTexel};
}

Texture paint_puddles(std::uint64_t seed) {
  RandomNumbers random(seed ^ 0x776574ULL);
  constexpr float kFilm = 90.0F;
  Canvas canvas(kToneSide, kToneSide, kFilm);
  canvas.dead_leaves(random, {4.0, 60.0, 0.3, 90.0, 0.0});
  return {canvas, kToneTexel};
}

RoadDecal paint_decal(const RoadLook& look, const Leg& leg, std::uint64_t seed) {
  RandomNumbers random(seed);
  const Eigen::Vector2d low(0.0, -6.4);
  const Eigen::Vector2d high(leg.length_m, 9.6);
  DecalCanvas road(low, high);
  if (look.details) {
    pave(random, road, low.y() + 0.2, -4.6, leg.length_m);
    pave(random, road, 8.0, high.y() - 0.2, leg.length_m);
    repair(random, road, leg.length_m);
  }
  if (look.slabs) paint_joints(road, low.y(), high.y(), leg.length_m);
  paint_lines(road, leg.length_m, look.paint * kPaint);
  if (look.details) paint_zebra(random, road, leg.length_m - 5.0);
  return {low, high, {road.texels(), kDecalTexel}};
}

}  // namespace oneac::simulation
