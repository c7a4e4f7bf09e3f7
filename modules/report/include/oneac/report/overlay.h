#pragma once

#include "oneac/base/image.h"

#include <Eigen/Core>

#include <array>
#include <string>
#include <vector>

namespace oneac {

// The colour code of all pictures: blue is good, orange is poor, and what lies between is mixed.
// They differ for every kind of colour vision, and from grey.

/// Red, green, blue of a share: 0 good … 1 poor.
[[nodiscard]] std::array<int, 3> colour_of(double poor);

/// A correspondence on the second image of a pair.
struct Mark {
  Eigen::Vector2d u1, u2;                           ///< [px] in the first and second image
  Eigen::Matrix2d A = Eigen::Matrix2d::Identity();  ///< ∂u2/∂u1 [px/px]
  double poor = 0.0;                                ///< 0 good … 1 poor
};

/// The second image of a pair with its correspondences.
struct Overlay {
  int width = 0;     ///< [px] of the image that marks refer to
  int height = 0;    ///< [px]
  std::string jpeg;  ///< of any size with the same sides' ratio
  std::vector<Mark> marks;
};

/// JPEG no wider than a page shows it. @throws std::invalid_argument without pixels
[[nodiscard]] std::string jpeg_of(const ImageView& image);

/// The image itself as a grey PNG. @throws std::invalid_argument without pixels
[[nodiscard]] std::string png_of(const ImageView& image);

/// An <svg> element to stand in an HtmlPage: the image, a line from u1 to u2 of each correspondence
/// and around u2 the parallelogram that A makes of a square of the first image. The poorer half is
/// orange, the others are blue and on top. Marks that are not finite are left out.
[[nodiscard]] std::string overlay_svg(const Overlay& overlay);

/// The same in pixels, as a PNG, each mark in its own mixture.
/// @throws std::invalid_argument without pixels
[[nodiscard]] std::string overlay_png(const ImageView& image, const std::vector<Mark>& marks);

/// Fields of an image tinted, each with a number; `rows` × `columns` of them, row by row.
struct TintedField {
  std::string number;  ///< empty: neither tint nor number
  double poor = 0.0;   ///< 0 good … 1 poor
};
/// @throws std::invalid_argument without pixels, or when fields are not rows × columns
[[nodiscard]] std::string tinted_png(const ImageView& image, int rows, int columns,
                                     const std::vector<TintedField>& fields);

}  // namespace oneac
