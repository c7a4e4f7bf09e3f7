// Results of a run as arrays, and their errors against a reference.
#include "bindings.h"
#include "records.h"

#include "oneac/evaluation/covariance_io.h"
#include "oneac/evaluation/evaluate.h"
#include "oneac/geometry/angles.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

namespace oneac::python {
namespace {

constexpr double kDegrees = 57.29577951308232;

py::object statistics_in(const std::optional<Statistics>& s, double unit) {
  if (!s) return py::none();
  return result_class("Statistics")(s->count, s->mean * unit, s->median * unit, s->p95 * unit,
                                    s->rmse * unit, s->max * unit);
}

py::object covariances(const std::filesystem::path& path) {
  const std::vector<CovarianceRow> rows = read_covariances(path);
  Doubles covariance(Shape{static_cast<py::ssize_t>(rows.size()), 6, 6});
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::copy_n(rows[i].covariance.data(), 36, covariance.mutable_data() + 36 * i);  // symmetric
  }
  using Row = CovarianceRow;
  return result_class("Covariances")(
      column<std::int64_t>(rows, [](const Row& r) { return r.index1; }),
      column<std::int64_t>(rows, [](const Row& r) { return r.index2; }), covariance,
      rows_of(rows, 3, [](const Row& r) { return r.position_sigma; }));
}

py::object pair_errors(const std::vector<PairError>& pairs) {
  return result_class("PairErrors")(
      column<std::int64_t>(pairs, [](const PairError& p) { return p.index1; }),
      column<std::int64_t>(pairs, [](const PairError& p) { return p.index2; }),
      column<double>(pairs, [](const PairError& p) { return p.true_step; }),
      column<double>(pairs, [](const PairError& p) { return p.rotation * kDegrees; }),
      column<double>(pairs,
                     [](const PairError& p) { return p.direction.value_or(kAbsent) * kDegrees; }),
      column<double>(pairs, [](const PairError& p) { return p.length.value_or(kAbsent); }),
      column<bool>(pairs, [](const PairError& p) { return p.is_bad(); }));
}

py::object trajectory_part(const TrajectoryErrors& errors) {
  py::object t_rel = py::none(), r_rel = py::none(), scale = py::none();
  if (errors.subsequences) {
    t_rel = py::float_(errors.subsequences->translation * 100.0);
    r_rel = py::float_(errors.subsequences->rotation * kDegrees * 100.0);
  }
  if (errors.scale_error) scale = py::float_(*errors.scale_error);
  return result_class("TrajectoryErrors")(errors.frames, errors.length, name_of(errors.alignment),
                                          errors.aligned_scale, statistics_in(errors.ape, 1.0),
                                          t_rel, r_rel, scale);
}

py::object to_python(const Evaluation& found) {
  py::object rotation = py::none(), direction = py::none(), length = py::none();
  std::size_t bad = 0;
  if (found.pair_summary) {
    rotation = statistics_in(found.pair_summary->rotation, kDegrees);
    direction = statistics_in(found.pair_summary->direction, kDegrees);
    length = statistics_in(found.pair_summary->length, 1.0);
    bad = found.pair_summary->bad;
  }
  const py::object trajectory =
      found.trajectory ? trajectory_part(*found.trajectory) : py::object(py::none());
  return result_class("Evaluation")(pair_errors(found.pairs), rotation, direction, length, bad,
                                    trajectory, found.notes);
}

py::object evaluate(const py::object& poses, const py::object& estimate,
                    const py::object& reference, const std::string& alignment) {
  const Alignment aligned = alignment_from_name(alignment);
  if (poses.is_none() && estimate.is_none()) {
    throw std::invalid_argument("relative_poses and trajectory are None, must be one or both");
  }
  const auto rows = poses.is_none() ? std::vector<RelativePoseRow>{} : rows_from(poses);
  const Trajectory truth = trajectory_from(reference, "reference");
  if (estimate.is_none()) return to_python(evaluate_pairs(rows, truth));
  const Trajectory path = trajectory_from(estimate, "trajectory");
  if (poses.is_none()) return to_python(evaluate_trajectory(path, truth, aligned));
  Evaluation found = evaluate_run(rows, path, truth, aligned);
  if (!found.trajectory) {
    found.notes.push_back(rows.empty() ? "relative_poses has no rows that tell the trajectory's "
                                         "frames: None for it compares the trajectory alone"
                                       : "trajectory has no frame in common with reference");
  }
  return to_python(found);
}

}  // namespace

void bind_files(py::module_& m) {
  m.def(
      "read_relative_poses",
      [](const std::filesystem::path& path) { return to_python(read_relative_poses(path)); },
      py::arg("path"), "A relative_poses.csv as oneac.RelativePoses. InputError with its line.");
  m.def(
      "read_trajectory",
      [](const std::filesystem::path& path) { return to_python(read_trajectory(path)); },
      py::arg("path"),
      "A trajectory as oneac.Trajectory: KITTI, TUM, EuRoC, 4×4, as `oneac eval` reads it.");
  m.def("read_covariances", &covariances, py::arg("path"),
        "A covariance.csv as oneac.Covariances. InputError with its line.");
  m.def("evaluate", &evaluate, py::arg("relative_poses"), py::arg("trajectory"),
        py::arg("reference"), py::arg("alignment") = "se3",
        "Errors as `oneac eval` and the report of a run have them: oneac.Evaluation.\n\n"
        "relative_poses: RelativePoses or None; trajectory: Trajectory of the camera or None;\n"
        "reference: Trajectory of the camera, T_world_camera [m]; alignment: none, se3 or sim3.\n"
        "With both, rows are associated by the pairs' indices or times; of a trajectory alone by\n"
        "time when both have times, else row by row when they are as many. ValueError when pairs\n"
        "are no chain or rows do not fit, and for what is no rotation.");
}

}  // namespace oneac::python
