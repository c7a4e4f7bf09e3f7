#pragma once

#include "arrays.h"

#include "oneac/solvers/registry.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace oneac::python {

using Counts = py::array_t<std::int64_t, py::array::c_style>;

/// One sample (…, or a point alone where one is enough), or many of them.
struct Samples {
  bool stacked;       ///< many
  std::size_t count;  ///< of samples
};

/// Room for `capacity` poses per sample.
struct PoseArrays {
  PoseArrays(const Samples& samples, std::size_t capacity)
      : R(shape_for(samples, capacity, {3, 3})),
        t(shape_for(samples, capacity, {3})),
        n(shape_for(samples, capacity, {3})),
        count(shape_of_count(samples)) {}

  static Shape shape_of_count(const Samples& samples) {
    return samples.stacked ? Shape{static_cast<py::ssize_t>(samples.count)} : Shape{};
  }

  static Shape shape_for(const Samples& samples, std::size_t capacity,
                         std::initializer_list<py::ssize_t> more) {
    Shape shape;
    if (samples.stacked) shape.push_back(static_cast<py::ssize_t>(samples.count));
    shape.push_back(static_cast<py::ssize_t>(capacity));
    shape.insert(shape.end(), more);
    return shape;
  }
  [[nodiscard]] py::object to_python() const { return result_class("Poses")(R, t, n, count); }

  Doubles R, t, n;
  Counts count;
};

/// The arrays' memory, for use without the interpreter.
struct PoseMemory {
  explicit PoseMemory(PoseArrays& arrays)
      : R(arrays.R.mutable_data()),
        t(arrays.t.mutable_data()),
        n(arrays.n.mutable_data()),
        count(arrays.count.mutable_data()) {}

  /// One sample's poses, which fill the arrays.
  void put(const PoseSet& poses) const {
    count[0] = static_cast<std::int64_t>(poses.size());
    for (std::size_t i = 0; i < poses.size(); ++i) put_row(i, poses[i].motion, poses[i].n);
  }
  /// The rows of sample `first` and those after it.
  [[nodiscard]] PoseRows rows_from(std::size_t first, std::size_t capacity) const {
    const std::size_t row = first * capacity;
    return {R + 9 * row, t + 3 * row, n + 3 * row, count + first, capacity};
  }
  /// A block of planar motions, one or none per sample, as the list's batch forms give them.
  void operator()(std::size_t first, std::size_t size, const PlanarPoseArrays& poses) const {
    for (std::size_t i = 0; i < size; ++i) {
      const PlanarPose pose{poses.cos_alpha[i], poses.sin_alpha[i], poses.tx[i], poses.tz[i]};
      const bool valid = poses.valid[i] != 0;
      count[first + i] = valid ? 1 : 0;
      put_row(first + i, pose.pose(), {0.0, valid ? 1.0 : 0.0, 0.0});
    }
  }
  void put_row(std::size_t at, const RelativePose& motion, const Eigen::Vector3d& normal) const {
    put_matrix3(motion.R, R + 9 * at);
    std::copy_n(motion.t.data(), 3, t + 3 * at);
    std::copy_n(normal.data(), 3, n + 3 * at);
  }

  double *R, *t, *n;
  std::int64_t* count;
};

}  // namespace oneac::python
