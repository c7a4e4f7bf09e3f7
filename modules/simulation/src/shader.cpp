#include "shader.h"

#include "facade_painter.h"
#include "random_numbers.h"
#include "sky_painter.h"

#include <algorithm>
#include <cmath>

namespace oneac::simulation {
namespace {

constexpr float kToneCos = 0.7986F;  // the slow tone lies 37° askew over the asphalt
constexpr float kToneSin = 0.6018F;

constexpr float kOtherGround = 0.8F;  // of a lower sun on the road
constexpr double kCeiling_m = 500.0;  // of the clouds
constexpr float kOvercast = 190.0F;   // what the haze above the horizon looks like
constexpr float kHaze = 0.03F;        // sine of the elevation below which no cloud is seen

/// Light from the south-west and above: corners of buildings stand out.
float illumination(const Face& face, bool upper) {
  switch (face.axis) {
    case 0:
      return upper ? 0.80F : 1.08F;
    case 1:
      return upper ? 0.68F : 1.0F;
    default:
      return 1.15F;
  }
}

/// Light of another hour: from the north-east, lower and weaker.
float other_illumination(const Face& face, bool upper) {
  switch (face.axis) {
    case 0:
      return upper ? 0.95F : 0.62F;
    case 1:
      return upper ? 0.88F : 0.58F;
    default:
      return 0.90F;
  }
}

Footprint rotated(const Footprint& patch, const Eigen::Matrix2f& R) {
  return {R * patch.centre, R * patch.right, R * patch.down};
}

/// The patch of the face's plane that a pixel sees, in its two in-plane axes.
Footprint footprint(const RayFan& fan, const Face& face, double u, double v) {
  const Eigen::Vector3d ray = fan.ray(u, v);
  const double plane = face.offset - fan.centre[face.axis];
  const double w = ray[face.axis] / plane;
  const int a = face.first();
  const int b = face.second();
  const Eigen::Vector2d centre(fan.centre[a], fan.centre[b]);
  const Eigen::Vector2d r(ray[a], ray[b]);
  const auto step = [&](const Eigen::Vector3d& d) -> Eigen::Vector2f {  // quotient rule on r / w
    return ((Eigen::Vector2d(d[a], d[b]) - r * (d[face.axis] / plane / w)) / w).cast<float>();
  };
  return {(centre + r / w).cast<float>(), step(fan.du), step(fan.dv)};
}

Eigen::Matrix2f leg_from_world(const Leg& leg) {
  const Eigen::Vector2d x = leg.to_world({1.0, 0.0}) - leg.start;
  Eigen::Matrix2f R;
  R << static_cast<float>(x.x()), static_cast<float>(x.y()), static_cast<float>(-x.y()),
      static_cast<float>(x.x());
  return R;
}

Texture paint_box(const Box& box, std::uint64_t wall_seed, std::uint64_t obstacle_seed) {
  switch (box.kind) {
    case Box::Kind::kBuilding:
    case Box::Kind::kFarBuilding:
      return paint_facade(box, wall_seed);
    case Box::Kind::kTruck:
      return paint_truck(box, obstacle_seed);
    default:
      return paint_obstacle(box, obstacle_seed);
  }
}

}  // namespace

Shader::Shader(const Route& route, const std::vector<Box>& boxes, const SimulationOptions& options,
               bool relit)
    : relit_(relit),
      legs_(route.legs()),
      asphalt_(paint_asphalt(road_look(options.road), options.seed)),
      tone_(paint_road_tone(road_look(options.road), options.seed)) {
  const RoadLook look = road_look(options.road);
  const auto own_seed = [&options](std::size_t kind, std::size_t i) {
    return mix_bits(options.seed ^ (kind << 32U)) + (options.alike ? 0 : i);
  };
  for (std::size_t i = 0; i < legs_.size(); ++i) {
    decals_.push_back(paint_decal(look, legs_[i], own_seed(1, i)));
  }
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    box_textures_.push_back(paint_box(boxes[i], own_seed(2, i), own_seed(relit ? 4 : 3, i)));
  }
  if (options.scenery == Scenery::kFar) clouds_ = paint_clouds(options.seed);
  if (look.wet) puddles_ = paint_puddles(options.seed);
}

float Shader::mirrored(const RayFan& fan, double u, double v) const {
  if (!puddles_) return 0.0F;
  constexpr float kHeadOn = 0.02F;  // of water, by Schlick's approximation of Fresnel's equations
  const Eigen::Vector3d ray = fan.ray(u, v);
  const auto slant = static_cast<float>(std::abs(ray.z()) / ray.norm());
  const float fresnel = kHeadOn + (1.0F - kHeadOn) * std::pow(1.0F - slant, 5.0F);
  const float wet = puddles_->sample(footprint(fan, Face{}, u, v)) / 255.0F;
  return fresnel * std::clamp(wet, 0.0F, 1.0F);
}

float Shader::face(const RayFan& fan, const Face& face, const std::vector<Box>& boxes, double u,
                   double v) const {
  const Footprint patch = footprint(fan, face, u, v);
  if (face.box < 0) return ground(patch);
  return wall(face, boxes[static_cast<std::size_t>(face.box)], patch);
}

float Shader::ground(const Footprint& patch) const {
  Eigen::Matrix2f askew;
  askew << kToneCos, -kToneSin, kToneSin, kToneCos;
  const auto neutral = static_cast<float>(kNeutral);
  float grey = asphalt_.sample(patch) + tone_.sample(rotated(patch, askew)) - neutral;
  for (std::size_t i = 0; i < legs_.size(); ++i) {
    const Eigen::Vector2d p = legs_[i].to_leg(patch.centre.cast<double>());
    const RoadDecal& decal = decals_[i];
    if ((p.array() < decal.low.array()).any() || (p.array() > decal.high.array()).any()) continue;
    Footprint local = rotated(patch, leg_from_world(legs_[i]));
    local.centre = (p - decal.low).cast<float>();
    grey += decal.texture.sample(local) - neutral;
  }
  return relit_ ? kOtherGround * grey : grey;
}

float Shader::wall(const Face& face, const Box& box, const Footprint& patch) const {
  const Texture& texture = box_textures_[static_cast<std::size_t>(face.box)];
  const float light =
      relit_ ? other_illumination(face, face.upper) : illumination(face, face.upper);
  Footprint local = patch;
  if (face.axis == 2) {
    local.centre -= box.low.head<2>().cast<float>();
    return light * texture.sample(local);
  }
  // In-plane axes: (y, z) on faces across x, (z, x) on faces across y. The latter are mirrored, so
  // that the two visible sides of a corner do not look alike.
  const auto arrange = [&](const Eigen::Vector2f& p) -> Eigen::Vector2f {
    return face.axis == 0 ? Eigen::Vector2f(p.x(), -p.y()) : Eigen::Vector2f(-p.y(), -p.x());
  };
  const Eigen::Vector2f corner =
      face.axis == 0
          ? Eigen::Vector2f(static_cast<float>(box.low.y()), static_cast<float>(box.high.z()))
          : Eigen::Vector2f(static_cast<float>(box.high.z()), static_cast<float>(box.high.x()));
  local.centre = arrange(patch.centre - corner);
  local.right = arrange(patch.right);
  local.down = arrange(patch.down);
  return light * texture.sample(local);
}

float Shader::sky(const RayFan& fan, double u, double v) const {
  const Eigen::Vector3d ray = fan.ray(u, v);
  const auto rise = static_cast<float>(ray.z() / ray.norm());
  if (!clouds_) return 228.0F - 40.0F * std::clamp(rise, 0.0F, 1.0F);
  if (rise < kHaze) return kOvercast;
  Face ceiling;
  ceiling.offset = kCeiling_m;
  const float cloud = clouds_->sample(footprint(fan, ceiling, u, v));
  const float clear = std::min(1.0F, (rise - kHaze) / (3.0F * kHaze));
  return kOvercast + clear * (cloud - kOvercast);
}

}  // namespace oneac::simulation
