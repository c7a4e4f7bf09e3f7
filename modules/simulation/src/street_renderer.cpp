#include "street_renderer.h"

#include "random_numbers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace oneac::simulation {
namespace {

constexpr int kRowsAtOnce = 4;  // of a rolling shutter: below a quarter of a millisecond

/// The picture, sample by sample; where the road mirrors, with another one upside down in it.
class PixelPainter {
 public:
  PixelPainter(const Shader& shader, const RayFan& fan, const std::vector<Box>& boxes,
               const std::vector<Face>& faces, const FaceRasteriser& visible,
               const PixelPainter* mirror = nullptr)
      : shader_(shader),
        fan_(fan),
        boxes_(boxes),
        faces_(faces),
        visible_(visible),
        mirror_(mirror) {}

  [[nodiscard]] float pixel(int u, int v) const {
    const std::array<std::uint16_t, 4> ids{id(u, v, 0), id(u, v, 1), id(u, v, 2), id(u, v, 3)};
    if (ids[0] == ids[1] && ids[0] == ids[2] && ids[0] == ids[3]) return look(ids[0], u, v);
    float sum = 0.0F;
    for (int k = 0; k < 4; ++k) {
      sum += look(ids[static_cast<std::size_t>(k)], FaceRasteriser::pixel(2 * u + k % 2),
                  FaceRasteriser::pixel(2 * v + k / 2));
    }
    return 0.25F * sum;
  }

 private:
  [[nodiscard]] std::uint16_t id(int u, int v, int k) const {
    return visible_.face(2 * u + k % 2, 2 * v + k / 2);
  }
  [[nodiscard]] float look(std::uint16_t id, double u, double v) const {
    if (id == FaceRasteriser::kSky) return shader_.sky(fan_, u, v);
    const float own = shader_.face(fan_, faces_[id], boxes_, u, v);
    if (mirror_ == nullptr || faces_[id].box >= 0) return own;
    const float share = shader_.mirrored(fan_, u, v);
    const std::uint16_t seen = mirror_->id(static_cast<int>(u), static_cast<int>(v), 0);
    return own + share * (mirror_->look(seen, u, v) - own);
  }

  const Shader& shader_;
  const RayFan& fan_;
  const std::vector<Box>& boxes_;
  const std::vector<Face>& faces_;
  const FaceRasteriser& visible_;
  const PixelPainter* mirror_;
};

/// The rays as they go on from a mirror on the ground, drawn back to where they seem to come from.
RayFan below_ground(RayFan fan) {
  for (Eigen::Vector3d* part : {&fan.centre, &fan.origin, &fan.du, &fan.dv}) part->z() *= -1.0;
  return fan;
}

/// The town's boxes, then the traffic's where they start.
std::vector<Box> with_traffic(std::vector<Box> boxes, const std::vector<MovingVehicle>& traffic) {
  for (const MovingVehicle& vehicle : traffic) boxes.push_back(vehicle.at_start);
  return boxes;
}

std::vector<Box> standing_boxes(const Route& route, const SimulationOptions& options, bool relit) {
  if (options.scenery == Scenery::kFar) return lay_out_open_land(route, options.seed);
  return lay_out_street(route, {options.seed, options.alike, relit});
}

static_assert(FaceRasteriser::kPerSide == 2, "PixelPainter reads 2×2 samples per pixel");

bool contains(const Face& face, const Eigen::Vector3d& X) {
  const Eigen::Vector2d p(X[face.first()], X[face.second()]);
  return (p.array() >= face.low.array()).all() && (p.array() <= face.high.array()).all();
}

}  // namespace

StreetRenderer::StreetRenderer(const PinholeCamera& camera, const Route& route,
                               const SimulationOptions& options, std::vector<MovingVehicle> traffic,
                               bool relit)
    : camera_(camera),
      view_range_m_(options.scenery == Scenery::kFar ? kViewInTheOpen_m : kViewInTown_m),
      traffic_(std::move(traffic)),
      boxes_(with_traffic(standing_boxes(route, options, relit), traffic_)),
      shader_(route, boxes_, options, relit) {}

std::vector<Box> StreetRenderer::boxes_at(double time_s) const {
  std::vector<Box> boxes = boxes_;
  const std::size_t first = boxes.size() - traffic_.size();
  for (std::size_t i = 0; i < traffic_.size(); ++i) boxes[first + i] = traffic_[i].at(time_s);
  return boxes;
}

std::vector<float> StreetRenderer::render(const Eigen::Isometry3d& T_world_cam,
                                          double time_s) const {
  std::vector<float> grey;
  grey.reserve(static_cast<std::size_t>(camera_.width) * static_cast<std::size_t>(camera_.height));
  render_rows(RayFan(camera_, T_world_cam), time_s, camera_.height, grey);
  return grey;
}

std::vector<float> StreetRenderer::render_rolling(const PoseAt& T_world_cam, double time_s,
                                                  double shutter_s) const {
  std::vector<float> grey;
  grey.reserve(static_cast<std::size_t>(camera_.width) * static_cast<std::size_t>(camera_.height));
  for (int v = 0; v < camera_.height; v += kRowsAtOnce) {
    const int rows = std::min(kRowsAtOnce, camera_.height - v);
    const double now = time_s + shutter_s * (v + 0.5 * (rows - 1)) / (camera_.height - 1);
    render_rows(RayFan(camera_, T_world_cam(now)).from_row(v), now, rows, grey);
  }
  return grey;
}

/// Appends the first rows of the fan.
void StreetRenderer::render_rows(const RayFan& fan, double time_s, int rows,
                                 std::vector<float>& grey) const {
  const std::vector<Box> boxes = boxes_at(time_s);
  const std::vector<Face> faces = faces_towards(boxes, fan.centre, view_range_m_);
  const FaceRasteriser visible(fan, faces, camera_.width, rows);
  const RayFan below = below_ground(fan);
  std::vector<Face> above;
  if (shader_.mirrors()) above = faces_towards(boxes, below.centre, view_range_m_);
  if (!above.empty()) above.erase(above.begin());  // the ground
  // Above a road with nothing beside it the mirror shows sky, not nothing.
  const FaceRasteriser reflected(below, above, camera_.width, shader_.mirrors() ? rows : 0);
  const PixelPainter mirror(shader_, below, boxes, above, reflected);
  const PixelPainter painter(shader_, fan, boxes, faces, visible,
                             shader_.mirrors() ? &mirror : nullptr);
  for (int v = 0; v < rows; ++v) {
    for (int u = 0; u < camera_.width; ++u) grey.push_back(painter.pixel(u, v));
  }
}

std::optional<Eigen::Vector3d> StreetRenderer::surface_point(const Eigen::Isometry3d& T_world_cam,
                                                             const Eigen::Vector2d& u_px,
                                                             double time_s) const {
  const RayFan fan(camera_, T_world_cam);
  const Eigen::Vector3d ray = fan.ray(u_px.x(), u_px.y());
  double nearest = 1.0 / kFarthest_m;
  std::optional<Eigen::Vector3d> hit;
  for (const Face& face : faces_towards(boxes_at(time_s), fan.centre, view_range_m_)) {
    const double w = face.inverse_depth(fan, ray);
    if (!(w > nearest)) continue;
    const Eigen::Vector3d X = fan.centre + ray / w;
    if (!contains(face, X)) continue;
    nearest = w;
    hit = X;
  }
  return hit;
}

GreyImage expose(const std::vector<float>& grey, int width, int height, double sigma,
                 std::uint64_t key) {
  GreyImage image(width, height);
  const std::uint64_t stream = mix_bits(key);
  std::size_t i = 0;
  for (int v = 0; v < height; ++v) {
    std::uint8_t* row = image.row(v);
    for (int u = 0; u < width; ++u, ++i) {
      const double noise = sigma > 0.0 ? sigma * normal_from_bits(mix_bits(stream + i)) : 0.0;
      row[u] = static_cast<std::uint8_t>(std::clamp(grey[i] + noise + 0.5, 0.0, 255.0));
    }
  }
  return image;
}

}  // namespace oneac::simulation
