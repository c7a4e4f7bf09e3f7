#include "oneac/report/overlay.h"

#include "marks.h"
#include "svg_canvas.h"

#include "oneac/report/html_page.h"

#include <algorithm>
#include <cmath>

namespace oneac {
namespace {

using internal::place;
using Rgb = std::array<int, 3>;

constexpr double kHalfSide = 8.0;  // [px] of the square around u1: half a window of a tracker
constexpr Rgb kGood = {79, 195, 255}, kPoor = {255, 140, 46};

std::string at(const Eigen::Vector2d& u) {
  return place(u.x()) + " " + place(u.y());
}

std::string outline(const Mark& mark) {
  std::string path = "M" + at(mark.u1) + "L" + at(mark.u2);
  char pen = 'M';
  for (const Eigen::Vector2d& corner : internal::corners_of(mark)) {
    path += pen + at(corner);
    pen = 'L';
  }
  return path + "Z";
}

std::string path_svg(const char* style, double poor, const std::string& path) {
  const Rgb c = colour_of(poor);
  return "<path class=\"" + std::string(style) + "\" stroke=\"rgb(" + std::to_string(c[0]) + "," +
         std::to_string(c[1]) + "," + std::to_string(c[2]) + ")\" d=\"" + path + "\"/>";
}

}  // namespace

namespace internal {

bool is_finite(const Mark& mark) {
  return mark.u1.allFinite() && mark.u2.allFinite() && mark.A.allFinite();
}

std::array<Eigen::Vector2d, 4> corners_of(const Mark& mark) {
  const auto corner = [&](double x, double y) {
    return Eigen::Vector2d(mark.u2 + kHalfSide * (mark.A * Eigen::Vector2d(x, y)));
  };
  return {corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)};
}

}  // namespace internal

std::array<int, 3> colour_of(double poor) {
  Rgb colour{};
  const double share = std::clamp(poor, 0.0, 1.0);
  for (std::size_t i = 0; i < 3; ++i) {
    colour[i] = static_cast<int>(std::lround(kGood[i] + share * (kPoor[i] - kGood[i])));
  }
  return colour;
}

std::string overlay_svg(const Overlay& overlay) {
  std::string good, poor;
  for (const Mark& mark : overlay.marks) {
    if (internal::is_finite(mark)) (mark.poor > 0.5 ? poor : good) += outline(mark);
  }
  const std::string width = std::to_string(overlay.width);
  const std::string height = std::to_string(overlay.height);
  // The image starts half a pixel before the centre of its first one.
  return "<svg class=\"overlay\" viewBox=\"-0.5 -0.5 " + width + " " + height +
         "\"><image x=\"-0.5\" y=\"-0.5\" width=\"" + width + "\" height=\"" + height +
         "\" preserveAspectRatio=\"none\" href=\"data:image/jpeg;base64," +
         base64_of(overlay.jpeg) + "\"/>\n" + path_svg("outlier", 1.0, poor) + "\n" +
         path_svg("inlier", 0.0, good) + "</svg>\n";
}

}  // namespace oneac
