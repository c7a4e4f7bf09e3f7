#include "records.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <stdexcept>

namespace oneac::python {
namespace {

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

/// An attribute as an array of `count` rows. @throws std::invalid_argument
Doubles attribute(const py::object& owner, const char* name, const Shape& shape) {
  const Doubles array = numbers(owner.attr(name), name, shape);
  require_finite(array, name);
  return array;
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
  const Doubles index1 = attribute(poses, "index1", {-1});
  const py::ssize_t count = index1.size();
  const Doubles index2 = attribute(poses, "index2", {count});
  const Doubles t1 = attribute(poses, "t1", {count}), t2 = attribute(poses, "t2", {count});
  const Doubles R = attribute(poses, "R", {count, 3, 3}), t = attribute(poses, "t", {count, 3});
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
    rows[i].T_2_1 = {matrix3_at(R.data() + 9 * i),
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

Trajectory trajectory_from(const py::object& given) {
  const Doubles T = attribute(given, "T", {-1, 4, 4});
  const std::size_t count = static_cast<std::size_t>(T.shape(0));
  Trajectory trajectory;
  trajectory.poses.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    trajectory.poses[i].matrix() =
        Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(T.data() + 16 * i);
  }
  if (!given.attr("times").is_none()) {
    const Doubles times = attribute(given, "times", {T.shape(0)});
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
