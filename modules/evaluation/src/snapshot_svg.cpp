#include "oneac/evaluation/snapshot_svg.h"

#include "svg_canvas.h"

#include "oneac/evaluation/html_page.h"

#include <array>
#include <stdexcept>

namespace oneac {
namespace {

using internal::place;

constexpr double kHalfSide = 8.0;  // [px] of the square around x1: half a window of a tracker

std::string at(const Eigen::Vector2d& u) {
  return place(u.x()) + " " + place(u.y());
}

std::string outline(const AffineCorrespondence& ac) {
  std::string path = "M" + at(ac.x1) + "L" + at(ac.x2);
  const std::array<Eigen::Vector2d, 4> corners = {
      Eigen::Vector2d(-kHalfSide, -kHalfSide), Eigen::Vector2d(kHalfSide, -kHalfSide),
      Eigen::Vector2d(kHalfSide, kHalfSide), Eigen::Vector2d(-kHalfSide, kHalfSide)};
  char pen = 'M';
  for (const Eigen::Vector2d& corner : corners) {
    path += pen + at(ac.x2 + ac.A * corner);
    pen = 'L';
  }
  return path + "Z";
}

}  // namespace

std::string snapshot_svg(const Snapshot& snapshot) {
  if (snapshot.inlier.size() != snapshot.acs.size()) {
    throw std::invalid_argument("snapshot: " + std::to_string(snapshot.inlier.size()) +
                                " flags for " + std::to_string(snapshot.acs.size()) +
                                " correspondences");
  }
  std::array<std::string, 2> paths;
  for (std::size_t i = 0; i < snapshot.acs.size(); ++i) {
    if (snapshot.acs[i].is_finite()) paths[snapshot.inlier[i] ? 1 : 0] += outline(snapshot.acs[i]);
  }
  const std::string width = std::to_string(snapshot.width);
  const std::string height = std::to_string(snapshot.height);
  // The image starts half a pixel before the centre of its first one.
  return "<svg class=\"snapshot\" viewBox=\"-0.5 -0.5 " + width + " " + height +
         "\"><image x=\"-0.5\" y=\"-0.5\" width=\"" + width + "\" height=\"" + height +
         "\" preserveAspectRatio=\"none\" href=\"data:image/jpeg;base64," +
         base64_of(snapshot.jpeg) + "\"/>\n<path class=\"outlier\" d=\"" + paths[0] +
         "\"/>\n<path class=\"inlier\" d=\"" + paths[1] + "\"/></svg>\n";
}

}  // namespace oneac
