// The planar solver that finds the focal length, too: what its row of the list leaves out.
#include "arrays.h"
#include "bindings.h"
#include "records.h"

#include "oneac/solvers/relpose_1ac_planar_focal.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace oneac::python {
namespace {

constexpr std::size_t kBlock = 512;  // correspondences: 32 kB, which the first cache holds

using Found = SolutionSet<PlanarFocalPose, 1>;

py::object to_python(const std::vector<Found>& all) {
  const auto of = [&](double PlanarFocalPose::*field, double otherwise) {
    return column<double>(
        all, [=](const Found& found) { return found.empty() ? otherwise : found[0].*field; });
  };
  return result_class("PlanarFocals")(
      of(&PlanarFocalPose::cos_alpha, 1.0), of(&PlanarFocalPose::sin_alpha, 0.0),
      of(&PlanarFocalPose::tx, 0.0), of(&PlanarFocalPose::tz, 0.0),
      of(&PlanarFocalPose::focal, kAbsent), of(&PlanarFocalPose::strength, 0.0),
      column<bool>(all, [](const Found& found) { return !found.empty(); }));
}

void require_ratio(double max_ratio) {
  if (max_ratio >= 1.0) return;
  throw std::invalid_argument("max_ratio = " + std::to_string(max_ratio) + ", must be at least 1");
}

AcInput row_of_acs(const py::object& x1, const py::object& x2, const py::object& A) {
  AcInput acs(x1, x2, A, true);
  if (acs.shape().size() == 1) return acs;
  Shape shape = acs.shape();
  shape.push_back(2);
  throw std::invalid_argument("x1 has shape " + text_of(shape) + ", must have (N, 2)");
}

py::object focal_of_each(const py::object& x1, const py::object& x2, const py::object& A,
                         double max_ratio) {
  require_ratio(max_ratio);
  const AcInput acs = row_of_acs(x1, x2, A);
  std::vector<Found> all;
  all.reserve(acs.size());
  {
    const py::gil_scoped_release release;
    std::vector<AffineCorrespondence> block(kBlock);
    for (std::size_t first = 0; first < acs.size(); first += kBlock) {
      const std::size_t count = std::min(kBlock, acs.size() - first);
      acs.require_finite(first, count);
      acs.load(first, count, block.data());
      for (std::size_t i = 0; i < count; ++i) {
        all.push_back(relpose_1ac_planar_focal(block[i], max_ratio));
      }
    }
  }
  return to_python(all);
}

py::object focal_of_all(const py::object& x1, const py::object& x2, const py::object& A,
                        const py::object& weights, double max_ratio) {
  require_ratio(max_ratio);
  const AcInput input = row_of_acs(x1, x2, A);
  const std::vector<AffineCorrespondence> acs = input.all();
  if (acs.empty()) throw std::invalid_argument("x1 has shape (0, 2), must have N ≥ 1");
  const auto count = static_cast<py::ssize_t>(acs.size());
  Doubles weight;
  if (!weights.is_none()) weight = numbers(weights, "weights", {count});
  if (!weights.is_none()) require_finite(weight, "weights");
  std::vector<Found> one(1);
  {
    const py::gil_scoped_release release;
    one[0] = relpose_nac_planar_focal(acs, weights.is_none() ? nullptr : weight.data(), max_ratio);
  }
  return to_python(one);
}

}  // namespace

void bind_focal(py::module_& m) {
  m.def("planar_focal", &focal_of_each, py::arg("x1"), py::arg("x2"), py::arg("A"), py::kw_only(),
        py::arg("max_ratio") = kAnyFocal,
        "PlanarFocals of each correspondence, (N, 2) and (N, 2, 2): relpose_1ac_planar_focal with\n"
        "the focal length that it finds. Points about the principal point over an assumed focal\n"
        "length, or in pixels; max_ratio keeps 1/max_ratio ≤ focal ≤ max_ratio.");
  m.def("planar_focal_of_all", &focal_of_all, py::arg("x1"), py::arg("x2"), py::arg("A"),
        py::kw_only(), py::arg("weights") = py::none(), py::arg("max_ratio") = kAnyFocal,
        "PlanarFocals of length 1: one motion and focal length of N ≥ 1 correspondences in\n"
        "algebraic least squares; weights (N,), none: all alike.");
}

}  // namespace oneac::python
