#include "arrays.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <stdexcept>

namespace oneac::python {
namespace {

constexpr double kRigid = 1e-6;  // [-] rounding of matrices that were printed and read

bool matches(const Shape& have, const Shape& want) {
  if (have.size() != want.size()) return false;
  for (std::size_t i = 0; i < have.size(); ++i) {
    if (want[i] >= 0 && have[i] != want[i]) return false;
  }
  return true;
}

[[noreturn]] void refuse_shape(const char* name, const Shape& have, const std::string& want) {
  throw std::invalid_argument(std::string(name) + " has shape " + text_of(have) + ", must have " +
                              want);
}

/// Whether any of them is NaN or infinite: v − v has no bit set otherwise. Wide without a branch.
bool any_not_finite(const double* values, std::size_t count) {
  std::uint64_t bad = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double zero = values[i] - values[i];
    std::uint64_t bits = 0;
    std::memcpy(&bits, &zero, sizeof bits);
    bad |= bits;
  }
  return bad != 0;
}

void require_rows(const double* values, std::size_t first, std::size_t count, std::size_t width,
                  const char* name) {
  const double* begin = values + first * width;
  if (!any_not_finite(begin, count * width)) return;
  const double* bad =
      std::find_if(begin, begin + count * width, [](double v) { return !std::isfinite(v); });
  throw std::invalid_argument(std::string(name) + "[" +
                              std::to_string(static_cast<std::size_t>(bad - values) / width) +
                              "] is not finite");
}

bool hides_entries(const py::handle& value) {
  // Held for ever.
  static const py::handle ndarray =
      py::module_::import("numpy").attr("ndarray").cast<py::object>().release();
  if (py::type::handle_of(value).is(ndarray) || !py::isinstance<py::array>(value)) return false;
  return py::cast<bool>(py::module_::import("numpy.ma").attr("is_masked")(value));
}

Shape with(Shape shape, std::initializer_list<py::ssize_t> more) {
  shape.insert(shape.end(), more);
  return shape;
}

}  // namespace

void require_unmasked(const py::object& value, const char* name) {
  bool masked = hides_entries(value);
  if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value)) {
    for (const py::handle part : value) masked = masked || hides_entries(part);
  }
  if (!masked) return;
  throw std::invalid_argument(std::string(name) +
                              " has masked entries, must have none (compressed, or filled)");
}

Doubles numbers(const py::object& value, const char* name) {
  require_unmasked(value, name);
  const auto array = py::array::ensure(value);
  if (!array) {
    PyErr_Clear();
    throw std::invalid_argument(std::string(name) + " is no array of numbers");
  }
  if (std::string("fiu").find(array.dtype().kind()) == std::string::npos) {
    throw std::invalid_argument(std::string(name) + " holds " +
                                py::cast<std::string>(py::str(array.dtype())) +
                                ", must hold real numbers");
  }
  return py::array_t<double, py::array::c_style | py::array::forcecast>(array);
}

Doubles numbers(const py::object& value, const char* name, const Shape& shape) {
  Doubles array = numbers(value, name);
  if (!matches(shape_of(array), shape)) refuse_shape(name, shape_of(array), text_of(shape));
  return array;
}

std::string text_of(const Shape& shape) {
  std::string text = "(";
  for (std::size_t i = 0; i < shape.size(); ++i) {
    if (i > 0) text += ", ";
    text += shape[i] < 0 ? "N" : std::to_string(shape[i]);
  }
  return text + (shape.size() == 1 ? ",)" : ")");
}

Shape shape_of(const py::array& array) {
  return {array.shape(), array.shape() + array.ndim()};
}

void require_finite(const Doubles& values, const char* name) {
  if (any_not_finite(values.data(), static_cast<std::size_t>(values.size()))) {
    throw std::invalid_argument(std::string(name) + " holds NaN or infinity");
  }
}

Eigen::Matrix3d matrix3(const py::object& value, const char* name) {
  if (value.is_none()) return Eigen::Matrix3d::Identity();
  const Doubles array = numbers(value, name, {3, 3});
  require_finite(array, name);
  return matrix3_at(array.data());
}

Eigen::Matrix3d rotation(const py::object& value, const char* name) {
  const Eigen::Matrix3d R = matrix3(value, name);
  if (!(R * R.transpose()).isIdentity(kRigid) || R.determinant() < 0.0) {
    throw std::invalid_argument(std::string(name) + " is no rotation: R Rᵀ must be I, det R be 1");
  }
  return R;
}

Eigen::Vector3d vector3(const py::object& value, const char* name) {
  const Doubles array = numbers(value, name, {3});
  require_finite(array, name);
  return Eigen::Map<const Eigen::Vector3d>(array.data());
}

Eigen::Isometry3d rigid(const py::object& value, const char* name) {
  const Doubles array = numbers(value, name, {4, 4});
  require_finite(array, name);
  Eigen::Isometry3d T;
  T.matrix() = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(array.data());
  const Eigen::Matrix3d R = T.linear();
  const bool last_row = T.matrix().row(3).isApprox(Eigen::RowVector4d(0, 0, 0, 1), kRigid);
  if (!last_row || !(R * R.transpose()).isIdentity(kRigid) || R.determinant() < 0.0) {
    throw std::invalid_argument(std::string(name) + " is no rigid 4×4 matrix");
  }
  return T;
}

Doubles to_numpy(const Eigen::MatrixXd& matrix) {
  Doubles array(Shape{matrix.rows(), matrix.cols()});
  Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
      array.mutable_data(), matrix.rows(), matrix.cols()) = matrix;
  return array;
}

Doubles to_numpy(const Eigen::Vector3d& vector) {
  Doubles array(Shape{3});
  Eigen::Map<Eigen::Vector3d>(array.mutable_data()) = vector;
  return array;
}

Doubles to_numpy(const Eigen::Isometry3d& pose) {
  return to_numpy(Eigen::MatrixXd(pose.matrix()));
}

py::object result_class(const char* name) {
  // Held for ever and looked up once each; the interpreter's lock guards it.
  static auto* classes = new std::map<std::string, py::object>();
  const auto found = classes->find(name);
  if (found != classes->end()) return found->second;
  const py::object made = py::module_::import("oneac._results").attr(name);
  return classes->emplace(name, made).first->second;
}

AcInput::AcInput(const py::object& x1, const py::object& x2, const py::object& A,
                 bool needs_affinity)
    : x1_array_(numbers(x1, "x1")), x2_array_(numbers(x2, "x2")) {
  shape_ = shape_of(x1_array_);
  if (shape_.empty() || shape_.back() != 2) refuse_shape("x1", shape_, "(..., 2)");
  if (shape_of(x2_array_) != shape_) {
    refuse_shape("x2", shape_of(x2_array_), "that of x1, " + text_of(shape_));
  }
  shape_.pop_back();
  for (const py::ssize_t axis : shape_) size_ *= static_cast<std::size_t>(axis);
  x1_ = x1_array_.data();
  x2_ = x2_array_.data();
  if (A.is_none()) {
    if (needs_affinity) throw std::invalid_argument("A is missing: the method uses affinities");
    return;
  }
  A_array_ = numbers(A, "A");
  const Shape wanted = with(shape_, {2, 2});
  if (shape_of(A_array_) != wanted) refuse_shape("A", shape_of(A_array_), text_of(wanted));
  A_ = A_array_.data();
}

void AcInput::require_finite(std::size_t first, std::size_t count) const {
  require_rows(x1_, first, count, 2, "x1");
  require_rows(x2_, first, count, 2, "x2");
  if (A_ != nullptr) require_rows(A_, first, count, 4, "A");
}

void AcInput::load(std::size_t first, std::size_t count, AffineCorrespondence* acs) const {
  using RowMajor2 = Eigen::Matrix<double, 2, 2, Eigen::RowMajor>;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = first + i;
    acs[i].x1 = {x1_[2 * at], x1_[2 * at + 1]};
    acs[i].x2 = {x2_[2 * at], x2_[2 * at + 1]};
    if (A_ != nullptr) acs[i].A = Eigen::Map<const RowMajor2>(A_ + 4 * at);
  }
}

std::vector<AffineCorrespondence> AcInput::all() const {
  std::vector<AffineCorrespondence> acs(size_);
  require_finite(0, size_);
  load(0, size_, acs.data());
  return acs;
}

}  // namespace oneac::python
