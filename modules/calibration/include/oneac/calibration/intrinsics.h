#pragma once

#include "oneac/geometry/camera.h"

#include <Eigen/Core>

#include <cstddef>

namespace oneac {

/// What of a camera can be learned, in the order of IntrinsicsVector. The ratio fy / fx and the
/// lens's other terms stay as they are.
enum Intrinsic : Eigen::Index { kFocal, kCentreX, kCentreY, kK1, kK2, kIntrinsics };

/// A change of a camera, all without unit: ln(f / f₀), (cx − cx₀) / f₀, (cy − cy₀) / f₀, k1 − k1₀,
/// k2 − k2₀.
using IntrinsicsVector = Eigen::Matrix<double, kIntrinsics, 1>;
using IntrinsicsMatrix = Eigen::Matrix<double, kIntrinsics, kIntrinsics>;

/// The camera after a change.
[[nodiscard]] PinholeCamera changed(const PinholeCamera& camera, const IntrinsicsVector& change);
/// The change that makes `to` of `from`, where they differ in nothing else.
[[nodiscard]] IntrinsicsVector change_between(const PinholeCamera& from, const PinholeCamera& to);

/// Normalised coordinates to the pixel of a raw image, by any LensModel.
[[nodiscard]] Eigen::Vector2d project_distorted(const PinholeCamera& camera,
                                                const Eigen::Vector2d& x);
/// The inverse; not finite where the model folds over.
[[nodiscard]] Eigen::Vector2d normalise_distorted(const PinholeCamera& camera,
                                                  const Eigen::Vector2d& u);

}  // namespace oneac
