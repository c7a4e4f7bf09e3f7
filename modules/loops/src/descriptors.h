#pragma once

#include "oneac/features/affine_features.h"

#include <Eigen/Core>

#include <cstdint>

namespace oneac::internal {

/// RootSIFT in a byte an entry, a quarter of the memory: half a step of 1/255 is a hundredth of the
/// distance of two descriptors that match.
using Descriptors8 = Eigen::Matrix<std::uint8_t, Eigen::Dynamic, 128, Eigen::RowMajor>;
using FloatDescriptors = AffineFeatures::Descriptors;
using FloatDescriptor = Eigen::Matrix<float, 1, 128>;

[[nodiscard]] inline Descriptors8 in_bytes(const FloatDescriptors& descriptors) {
  return (descriptors.array() * 255.0F + 0.5F).max(0.0F).min(255.0F).cast<std::uint8_t>().matrix();
}

[[nodiscard]] inline FloatDescriptors in_floats(const Descriptors8& descriptors) {
  return descriptors.cast<float>() / 255.0F;
}

}  // namespace oneac::internal
