#include "records.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <stdexcept>

namespace oneac::python {
namespace {

constexpr double kLastRow = 1e-6;  // [-] rounding of matrices that were multiplied or read

/// R (N, 3, 3) and t (N, 3) of poses T_2_1.
struct MotionColumns {
  explicit MotionColumns(const std::vector<RelativePoseRow>& rows)
      : R(Shape{static_cast<py::ssize_t>(rows.size()), 3, 3}),
        t(Shape{static_cast<py::ssize_t>(rows.size()), 3}) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      put_matrix3(rows[i].T_2_1.R, R.mutable_data() + 9 * i);
      std::copy_n(rows[i].T_2_1.t.data(), 3, t.mutable_data() + 3 * i);
    }
  }

  Doubles R, t;
};

py::list status_of(const std::vector<RelativePoseRow>& rows) {
  py::list status;
  for (const RelativePoseRow& row : rows) status.append(row.status);
  return status;
}

/// An argument and its attributes as arrays. @throws std::invalid_argument naming both
struct Attributes {
  [[nodiscard]] Doubles operator()(const char* attribute, const Shape& shape) const {
    const std::string full = std::string(name) + "." + attribute;
    const Doubles array = numbers(owner.attr(attribute), full.c_str(), shape);
    require_finite(array, full.c_str());
    return array;
  }

  const py::object& owner;
  const char* name;
};

[[noreturn]] void refuse_row(const std::string& name, std::size_t row, const char* fault) {
  throw std::invalid_argument(name + "[" + std::to_string(row) + "] is " + fault);
}

/// @throws std::invalid_argument naming the row for what a file's reader would refuse, too
Eigen::Matrix3d rotation_in(const Eigen::Matrix3d& M, const std::string& name, std::size_t row) {
  if (const auto R = nearest_rotation(M)) return *R;
  refuse_row(name, row, "no rotation: R Rᵀ must be I, det R be 1");
}

Eigen::Isometry3d pose_in(const double* row_major, const std::string& name, std::size_t row) {
  const Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> M(row_major);
  if (!M.row(3).isApprox(Eigen::RowVector4d(0, 0, 0, 1), kLastRow)) {
    refuse_row(name, row, "no rigid pose: its last row must be 0 0 0 1");
  }
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = rotation_in(M.topLeftCorner<3, 3>(), name, row);
  T.translation() = M.topRightCorner<3, 1>();
  return T;
}

std::size_t index_of(double number) {
  if (number < 0) throw std::invalid_argument("an index is below 0");
  return static_cast<std::size_t>(number);
}

}  // namespace

py::object to_python(const std::vector<RelativePoseRow>& rows) {
  using Row = RelativePoseRow;
  const MotionColumns motion(rows);
  return result_class("RelativePoses")(
      column<std::int64_t>(rows, [](const Row& r) { return r.index1; }),
      column<std::int64_t>(rows, [](const Row& r) { return r.index2; }),
      column<double>(rows, [](const Row& r) { return r.t1; }),
      column<double>(rows, [](const Row& r) { return r.t2; }), motion.R, motion.t,
      column<bool>(rows, [](const Row& r) { return r.metric; }),
      column<std::int64_t>(rows, [](const Row& r) { return r.inliers; }),
      column<std::int64_t>(rows, [](const Row& r) { return r.acs; }), status_of(rows),
      column<double>(rows, [](const Row& r) { return r.sigma_length.value_or(kAbsent); }));
}

std::vector<RelativePoseRow> rows_from(const py::object& poses) {
  const Attributes field{poses, "relative_poses"};
  const Doubles index1 = field("index1", {-1});
  const py::ssize_t count = index1.size();
  const Doubles index2 = field("index2", {count});
  const Doubles t1 = field("t1", {count}), t2 = field("t2", {count});
  const Doubles R = field("R", {count, 3, 3}), t = field("t", {count, 3});
  require_unmasked(poses.attr("metric"), "relative_poses.metric");
  const auto metric = py::cast<std::vector<bool>>(poses.attr("metric"));
  if (metric.size() != static_cast<std::size_t>(count)) {
    throw std::invalid_argument("metric has another length than index1");
  }
  std::vector<RelativePoseRow> rows(metric.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].index1 = index_of(index1.data()[i]);
    rows[i].index2 = index_of(index2.data()[i]);
    rows[i].t1 = t1.data()[i];
    rows[i].t2 = t2.data()[i];
    rows[i].T_2_1 = {rotation_in(matrix3_at(R.data() + 9 * i), "relative_poses.R", i),
                     Eigen::Map<const Eigen::Vector3d>(t.data() + 3 * i)};
    rows[i].metric = metric[i];
    rows[i].status = "ok";
  }
  return rows;
}

py::object to_python(const Trajectory& trajectory) {
  Doubles T(Shape{static_cast<py::ssize_t>(trajectory.poses.size()), 4, 4});
  double* out = T.mutable_data();
  for (const Eigen::Isometry3d& pose : trajectory.poses) {
    Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>{out} = pose.matrix();
    out += 16;
  }
  py::object times = py::none();
  if (trajectory.has_times()) {
    times = column<double>(trajectory.times, [](double time) { return time; });
  }
  return result_class("Trajectory")(T, times);
}

Trajectory trajectory_from(const py::object& given, const char* name) {
  const Attributes field{given, name};
  const Doubles T = field("T", {-1, 4, 4});
  const std::size_t count = static_cast<std::size_t>(T.shape(0));
  Trajectory trajectory;
  trajectory.poses.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    trajectory.poses[i] = pose_in(T.data() + 16 * i, std::string(name) + ".T", i);
  }
  if (!given.attr("times").is_none()) {
    const Doubles times = field("times", {T.shape(0)});
    trajectory.times.assign(times.data(), times.data() + times.size());
  }
  trajectory.validate();
  return trajectory;
}

py::array_t<std::uint8_t> to_numpy(const GreyImage& image) {
  py::array_t<std::uint8_t> array(Shape{image.height(), image.width()});
  const ImageView view = image.view();
  std::copy_n(view.data, static_cast<std::size_t>(array.size()), array.mutable_data());
  return array;
}

}  // namespace oneac::python
