#pragma once

#include "arrays.h"

#include "oneac/base/image.h"
#include "oneac/evaluation/relative_poses_io.h"
#include "oneac/evaluation/trajectory_io.h"

#include <limits>
#include <vector>

namespace oneac::python {

using Flags = py::array_t<bool, py::array::c_style>;
using Integers = py::array_t<std::int64_t, py::array::c_style>;

/// What stands in an array for a number that is not known.
inline constexpr double kAbsent = std::numeric_limits<double>::quiet_NaN();

/// Numbers taken from a list of things by a function.
template <class Number, class Things, class Take>
[[nodiscard]] py::array_t<Number, py::array::c_style> column(const Things& things, Take&& take) {
  py::array_t<Number, py::array::c_style> array(static_cast<py::ssize_t>(things.size()));
  Number* out = array.mutable_data();
  for (const auto& thing : things) *out++ = static_cast<Number>(take(thing));
  return array;
}
/// The same of vectors, (N, size); what `take` leaves empty becomes NaN.
template <class Things, class Take>
[[nodiscard]] Doubles rows_of(const Things& things, std::size_t size, Take&& take) {
  Doubles array(Shape{static_cast<py::ssize_t>(things.size()), static_cast<py::ssize_t>(size)});
  double* out = array.mutable_data();
  for (const auto& thing : things) {
    const auto row = take(thing);
    for (std::size_t i = 0; i < size; ++i) *out++ = row ? (*row)[static_cast<long>(i)] : kAbsent;
  }
  return array;
}

/// oneac.RelativePoses and back.
[[nodiscard]] py::object to_python(const std::vector<RelativePoseRow>& rows);
[[nodiscard]] std::vector<RelativePoseRow> rows_from(const py::object& relative_poses);
/// oneac.Trajectory and back.
/// @throws std::invalid_argument naming the argument, for poses that are not rigid and for what
///         validate() refuses
[[nodiscard]] py::object to_python(const Trajectory& trajectory);
[[nodiscard]] Trajectory trajectory_from(const py::object& trajectory, const char* name);

/// A copy of the pixels, (height, width) uint8.
[[nodiscard]] py::array_t<std::uint8_t> to_numpy(const GreyImage& image);

}  // namespace oneac::python
