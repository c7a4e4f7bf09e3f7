#include "facade_painter.h"

#include <algorithm>
#include <cmath>

namespace oneac::simulation {
namespace {

constexpr double kFacadeTexel = 0.025;     // [m] about a pixel at the nearest a facade is seen
constexpr double kFarTexel = 0.1;          // [m] half a pixel where a far house is nearest
constexpr double kObstacleTexel = 0.0125;  // [m] these stand nearer

/// A rectangle in metres. Written with braces, which fix the order in which random numbers are
/// drawn.
struct Mark {
  double u;
  double v;
  double width;
  double height;
  double value;
};

/// Paints in metres, v downwards from the top.
class FacadeCanvas {
 public:
  FacadeCanvas(double width_m, double height_m, double texel_m, float tone)
      : scale_(1.0 / texel_m), canvas_(texels(width_m), texels(height_m), tone) {}

  void rectangle(const Mark& mark) {
    const Eigen::Vector2d from(mark.u, mark.v);
    const Eigen::Vector2d size(mark.width, mark.height);
    canvas_.rectangle(scale_ * from, scale_ * (from + size), mark.value);
  }
  [[nodiscard]] Canvas& texels() { return canvas_; }

 private:
  [[nodiscard]] int texels(double metres) const {
    return std::max(8, static_cast<int>(std::ceil(metres * scale_)));
  }

  double scale_;
  Canvas canvas_;
};

/// Blobs of the given contrast, up to a fifth of the shorter side.
void stain(RandomNumbers& random, Canvas& canvas, double contrast, double coverage) {
  const double largest = std::min(canvas.width(), canvas.height()) * 0.2;
  canvas.dead_leaves(random, {1.2, largest, coverage, contrast, 0.35});
}

/// Small dirt over everything; openings keep their shape.
void soil(RandomNumbers& random, Canvas& canvas) {
  constexpr double kLargest = 7.0;  // [texels]
  canvas.dead_leaves(random, {1.2, kLargest, 0.05, 14.0, 0.2});
}

void lay_bricks(RandomNumbers& random, FacadeCanvas& wall, double width, double height) {
  const double brick = random.uniform(0.25, 0.5);
  const double course = random.uniform(0.1, 0.22);
  const double tone = random.uniform(90.0, 150.0);
  const double variation = random.uniform(8.0, 16.0);
  constexpr double kJoint = 0.02;
  bool shifted = false;
  double v = 0.0;
  while (v < height) {
    double u = shifted ? -0.5 * brick : 0.0;
    while (u < width) {
      wall.rectangle({u, v, brick - kJoint, course - kJoint, tone + variation * random.normal()});
      u += brick;
    }
    v += course;
    shifted = !shifted;
  }
}

/// A window or door with frame, panes of different reflections, and a sill or step.
void set_opening(RandomNumbers& random, FacadeCanvas& wall, const Eigen::Vector4d& place) {
  const double u = place[0];
  const double v = place[1];
  const double width = place[2];
  const double height = place[3];
  const double glass = random.uniform(25.0, 80.0);
  const double frame = random.uniform(150.0, 235.0);
  wall.rectangle({u, v, width, height, frame});
  const int across = random.integer(1, 3);
  const int down = random.integer(1, 3);
  constexpr double kBar = 0.06;
  const double pane_width = (width - kBar) / across - kBar;
  const double pane_height = (height - kBar) / down - kBar;
  for (int i = 0; i < across; ++i) {
    for (int j = 0; j < down; ++j) {
      const double pu = u + kBar + i * (pane_width + kBar);
      const double pv = v + kBar + j * (pane_height + kBar);
      wall.rectangle({pu, pv, pane_width, pane_height, glass + 14.0 * random.normal()});
      // A curtain, a blind or a reflection.
      wall.rectangle({pu + random.uniform(0.0, 0.6) * pane_width, pv,
                      random.uniform(0.2, 0.4) * pane_width, random.uniform(0.3, 1.0) * pane_height,
                      glass + random.uniform(10.0, 90.0)});
    }
  }
  wall.rectangle({u - 0.08, v + height, width + 0.16, 0.09, frame - 20.0});
  wall.rectangle({u - 0.08, v + height + 0.09, width + 0.16, 0.06, 45.0});
}

void set_storeys(RandomNumbers& random, FacadeCanvas& wall, double width, double height) {
  const double storey = random.uniform(2.8, 3.4);
  const double opening = random.uniform(0.9, 1.5);
  double base = height;
  while (base > 2.4) {
    double u = random.uniform(0.4, 1.2);
    while (u + opening < width - 0.3) {
      const bool door = base == height && random.chance(0.35);
      const double tall = door ? 2.2 : random.uniform(1.2, 1.6);
      const double top = door ? base - tall - 0.2 : base - 1.0 - tall;
      if (top > 0.2) {
        set_opening(random, wall, {u, top, opening + 0.2 * random.normal(), tall});
      }
      u += opening + random.uniform(0.7, 2.0);
    }
    base -= storey;
  }
}

/// Posters, signs, pipes: what makes one wall unlike another.
void hang_posters(RandomNumbers& random, FacadeCanvas& wall, double width, double height) {
  for (int n = static_cast<int>(width); n > 0; --n) {
    const double w = random.uniform(0.25, 1.1);
    const double h = random.uniform(0.25, 0.9);
    const double u = random.uniform(0.0, std::max(0.1, width - w));
    const double v = height - random.uniform(0.9, 2.8);
    const double ink = random.uniform(20.0, 230.0);
    wall.rectangle({u, v, w, h, random.uniform(40.0, 235.0)});
    for (int i = random.integer(2, 5); i > 0; --i) {
      wall.rectangle({u + random.uniform(0.0, 0.7) * w, v + random.uniform(0.0, 0.8) * h,
                      random.uniform(0.08, 0.3) * w, random.uniform(0.05, 0.2) * h, ink});
    }
  }
}

double longer_side(const Box& box) {
  return std::max(box.high.x() - box.low.x(), box.high.y() - box.low.y());
}

}  // namespace

Texture paint_facade(const Box& box, std::uint64_t seed) {
  RandomNumbers random(seed);
  const double width = longer_side(box);
  const double height = box.high.z();
  const double texel = box.kind == Box::Kind::kFarBuilding ? kFarTexel : kFacadeTexel;
  FacadeCanvas wall(width, height, texel, static_cast<float>(random.uniform(100.0, 190.0)));
  if (random.chance(0.5)) lay_bricks(random, wall, width, height);
  stain(random, wall.texels(), 12.0, 0.12);
  set_storeys(random, wall, width, height);
  hang_posters(random, wall, width, height);
  wall.rectangle({0.0, 0.0, width, 0.25, random.uniform(60.0, 200.0)});  // eaves
  soil(random, wall.texels());
  wall.texels().grain(random, 3.0);
  return {wall.texels(), texel};
}

Texture paint_truck(const Box& box, std::uint64_t seed) {
  RandomNumbers random(seed);
  const double width = longer_side(box);
  const double height = box.high.z();
  FacadeCanvas body(width, height, kObstacleTexel, 190.0F);
  stain(random, body.texels(), 10.0, 0.1);
  for (int layer = 0; layer < 3; ++layer) hang_posters(random, body, width, height);
  constexpr double kPanel = 0.8;
  double u = 0.0;
  while (u < width) {
    body.rectangle({u, 0.0, 0.03, height, 90.0});
    u += kPanel;
  }
  body.rectangle({0.0, 0.78 * height, width, 0.08, 30.0});
  body.rectangle({0.0, 0.86 * height, width, 0.14 * height, 45.0});  // bumper and wheels
  soil(random, body.texels());
  body.texels().grain(random, 3.0);
  return {body.texels(), kObstacleTexel};
}

Texture paint_obstacle(const Box& box, std::uint64_t seed) {
  RandomNumbers random(seed);
  const double width = longer_side(box);
  const double height = box.high.z();
  FacadeCanvas body(width, height, kObstacleTexel, static_cast<float>(random.uniform(60.0, 210.0)));
  stain(random, body.texels(), 12.0, 0.25);
  if (box.kind == Box::Kind::kVehicle) {
    set_opening(random, body, {0.12 * width, 0.1 * height, 0.35 * width, 0.35 * height});
    set_opening(random, body, {0.55 * width, 0.1 * height, 0.33 * width, 0.35 * height});
    body.rectangle({0.0, 0.62 * height, width, 0.05 * height, random.uniform(20.0, 230.0)});
    body.rectangle({0.0, 0.88 * height, width, 0.12 * height, 35.0});  // shadow under the sills
  }
  soil(random, body.texels());
  body.texels().grain(random, 3.0);
  return {body.texels(), kObstacleTexel};
}

}  // namespace oneac::simulation
