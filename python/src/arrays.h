#pragma once

#include "oneac/geometry/affine_correspondence.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstddef>
#include <string>
#include <vector>

/// What the parts of the binding share: numpy in, numpy out.
namespace oneac::python {

namespace py = pybind11;
using Doubles = py::array_t<double, py::array::c_style>;
using Shape = std::vector<py::ssize_t>;

/// Contiguous real numbers; copies only what is not. A list will do.
/// @throws std::invalid_argument (ValueError) naming the argument when it holds something else
[[nodiscard]] Doubles numbers(const py::object& value, const char* name);
/// The same with as many entries along each axis as `shape` says (−1: any).
[[nodiscard]] Doubles numbers(const py::object& value, const char* name, const Shape& shape);
/// @throws std::invalid_argument for an array of numpy.ma, or a list of them, that hides an entry:
///         it would count here
void require_unmasked(const py::object& value, const char* name);
/// "(3, 2)"; −1 is an N.
[[nodiscard]] std::string text_of(const Shape& shape);
[[nodiscard]] Shape shape_of(const py::array& array);
/// @throws std::invalid_argument naming the argument and the first entry that is NaN or infinite
void require_finite(const Doubles& values, const char* name);

/// A finite 3×3 matrix; the identity for None.
[[nodiscard]] Eigen::Matrix3d matrix3(const py::object& value, const char* name);
/// The same, that turns and does not stretch (within 1e-6).
[[nodiscard]] Eigen::Matrix3d rotation(const py::object& value, const char* name);
[[nodiscard]] Eigen::Vector3d vector3(const py::object& value, const char* name);
/// A finite rigid 4×4 matrix.
[[nodiscard]] Eigen::Isometry3d rigid(const py::object& value, const char* name);

[[nodiscard]] Doubles to_numpy(const Eigen::MatrixXd& matrix);
[[nodiscard]] Doubles to_numpy(const Eigen::Vector3d& vector);
/// 4×4.
[[nodiscard]] Doubles to_numpy(const Eigen::Isometry3d& pose);

/// Row-major numbers of numpy as what geometry calculates with.
[[nodiscard]] inline Eigen::Matrix3d matrix3_at(const double* row_major) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(row_major);
}
inline void put_matrix3(const Eigen::Matrix3d& matrix, double* row_major) {
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>{row_major} = matrix;
}

/// The result class of this name in oneac/_results.py.
[[nodiscard]] py::object result_class(const char* name);

/// Correspondences as Python gives them: x1, x2 (…, 2) and A (…, 2, 2), or None for bare points.
/// Holds the arrays; everything but making it needs no interpreter.
class AcInput {
 public:
  /// @param needs_affinity  A must not be None
  /// @throws std::invalid_argument naming the argument, its shape and what it must be
  AcInput(const py::object& x1, const py::object& x2, const py::object& A, bool needs_affinity);

  /// Without the last axis of the points.
  [[nodiscard]] const Shape& shape() const { return shape_; }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] const double* x1() const { return x1_; }
  [[nodiscard]] const double* x2() const { return x2_; }
  /// Null for bare points.
  [[nodiscard]] const double* A() const { return A_; }
  /// Copies from entry `first` on; they are as finite as require_finite() says.
  void load(std::size_t first, std::size_t count, AffineCorrespondence* acs) const;
  /// All of them. @throws as require_finite()
  [[nodiscard]] std::vector<AffineCorrespondence> all() const;
  /// @throws std::invalid_argument naming the first number of these that is not finite
  void require_finite(std::size_t first, std::size_t count) const;

 private:
  Doubles x1_array_, x2_array_, A_array_;
  const double *x1_ = nullptr, *x2_ = nullptr, *A_ = nullptr;
  Shape shape_;
  std::size_t size_ = 1;
};

}  // namespace oneac::python
