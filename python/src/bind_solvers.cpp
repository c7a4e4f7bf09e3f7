// Every row of the list of solvers (solvers/registry.h), on arrays.
#include "arrays.h"
#include "bindings.h"
#include "planar_forms.h"
#include "pose_arrays.h"
#include "solver_text.h"

#include "oneac/solvers/registry.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace oneac::python {
namespace {

using Flags = py::array_t<bool, py::array::c_style>;

Samples samples_of(const AcInput& acs, const Solver& solver) {
  Shape shape = acs.shape();
  const Shape given = with_points(shape);
  if (solver.sample > 1) {
    if (shape.empty() || shape.back() != static_cast<py::ssize_t>(solver.sample)) {
      throw std::invalid_argument(fault_of_samples(solver, given));
    }
    shape.pop_back();
  }
  if (shape.size() > 1) throw std::invalid_argument(fault_of_samples(solver, given));
  return {!shape.empty(), shape.empty() ? 1 : static_cast<std::size_t>(shape[0])};
}

std::size_t capacity_of(const Solver& solver) {
  return std::min<std::size_t>(static_cast<std::size_t>(solver.run.max_candidates) *
                                   (solver.surface == SolverSurface::kPlane ? 2 : 1),
                               PoseSet::kCapacity);
}

py::object poses_of_one(const PoseSet& poses) {
  const Samples one{false, 1};
  PoseArrays arrays(one, poses.size());
  PoseMemory(arrays).put(poses);
  return arrays.to_python();
}

/// Calls `take(first sample's number, correspondences of this and the next ones)` block by block.
template <class Take>
void for_each_block(const Solver& solver, const AcInput& acs, std::size_t samples, Take&& take) {
  std::array<AffineCorrespondence, kBlock> block;
  const std::size_t at_once = kBlock / solver.sample;
  for (std::size_t first = 0; first < samples; first += at_once) {
    const std::size_t count = std::min(at_once, samples - first) * solver.sample;
    acs.require_finite(first * solver.sample, count);
    acs.load(first * solver.sample, count, block.data());
    take(first, AcSpan(block.data(), count));
  }
}

/// Calls `take(sample's number, its correspondences)` for each sample.
template <class Take>
void for_each_sample(const Solver& solver, const AcInput& acs, std::size_t samples, Take&& take) {
  for_each_block(solver, acs, samples, [&](std::size_t first, AcSpan block) {
    for (std::size_t i = 0; i * solver.sample < block.size(); ++i) {
      take(first + i, AcSpan(block.begin() + i * solver.sample, solver.sample));
    }
  });
}

py::object solve(const Solver& solver, const py::object& x1, const py::object& x2,
                 const py::object& A) {
  const AcInput acs(x1, x2, A, solver.affine);
  const Samples samples = samples_of(acs, solver);
  if (!samples.stacked) {
    PoseSet poses;
    for_each_sample(solver, acs, 1,
                    [&](std::size_t, AcSpan sample) { poses = solver.run.poses(sample); });
    return poses_of_one(poses);
  }
  const std::size_t capacity = capacity_of(solver);
  PoseArrays arrays(samples, capacity);
  const PoseMemory memory(arrays);
  {
    const py::gil_scoped_release release;
    if (solver.batch != nullptr) {
      solve_in_blocks(solver, acs, memory);
    } else {
      for_each_block(solver, acs, samples.count, [&](std::size_t first, AcSpan block) {
        solver.run.rows(block, solver.sample, memory.rows_from(first, capacity));
      });
    }
  }
  return arrays.to_python();
}

py::tuple essentials(const Solver& solver, const py::object& x1, const py::object& x2,
                     const py::object& A) {
  const AcInput acs(x1, x2, A, solver.affine);
  const Samples samples = samples_of(acs, solver);
  const std::size_t capacity = capacity_of(solver);
  Doubles E(PoseArrays::shape_for(samples, capacity, {3, 3}));
  Counts count(PoseArrays::shape_of_count(samples));
  double* matrix = E.mutable_data();
  std::int64_t* counts = count.mutable_data();
  {
    const py::gil_scoped_release release;
    for_each_sample(solver, acs, samples.count, [&](std::size_t i, AcSpan sample) {
      const EssentialSet found = solver.run.essentials(sample);
      counts[i] = static_cast<std::int64_t>(found.size());
      for (std::size_t k = 0; k < capacity; ++k, matrix += 9) {
        put_matrix3(k < found.size() ? found[k] : Eigen::Matrix3d(Eigen::Matrix3d::Zero()), matrix);
      }
    });
  }
  return py::make_tuple(E, count);
}

py::object least_squares(const Solver& solver, const py::object& x1, const py::object& x2,
                         const py::object& A) {
  if (solver.run.least_squares == nullptr) {
    throw std::invalid_argument(std::string(solver.name) + " has no form for more than its sample");
  }
  const AcInput input(x1, x2, A, solver.affine);
  if (input.shape().size() != 1 || input.size() < solver.sample) {
    throw std::invalid_argument("x1 has shape " + text_of(with_points(input.shape())) +
                                ", must have (N, 2) with N ≥ " + std::to_string(solver.sample));
  }
  const std::vector<AffineCorrespondence> acs = input.all();
  PoseSet poses;
  {
    const py::gil_scoped_release release;
    poses = solver.run.least_squares(acs);
  }
  return poses_of_one(poses);
}

py::object planar(const Solver& solver, const py::object& x1, const py::object& x2,
                  const py::object& A) {
  if (!has_planar(solver)) {
    throw std::invalid_argument(std::string(solver.name) +
                                " does not give one planar motion per correspondence");
  }
  const AcInput acs(x1, x2, A, solver.affine);
  if (acs.shape().size() != 1) {
    throw std::invalid_argument("x1 has shape " + text_of(with_points(acs.shape())) +
                                ", must have (N, 2)");
  }
  const auto count = acs.shape().front();
  Doubles cos_alpha(count), sin_alpha(count), tx(count), tz(count);
  Flags valid(count);
  static_assert(sizeof(bool) == sizeof(std::uint8_t));
  const PlanarPoseArrays poses{cos_alpha.mutable_data(), sin_alpha.mutable_data(),
                               tx.mutable_data(), tz.mutable_data(),
                               reinterpret_cast<std::uint8_t*>(valid.mutable_data())};
  {
    const py::gil_scoped_release release;
    solve_planar(solver, acs, poses);
  }
  return result_class("PlanarPoses")(cos_alpha, sin_alpha, tx, tz, valid);
}

void bind_row_class(py::module_& m) {
  py::class_<Solver, std::unique_ptr<Solver, py::nodelete>>(
      m, "Solver", "A row of the list of solvers: what it assumes, and its forms.")
      .def_property_readonly("name", [](const Solver& s) { return std::string(s.name); })
      .def_property_readonly("label", [](const Solver& s) { return std::string(s.label); })
      .def_property_readonly("initialiser", [](const Solver& s) { return std::string(s.method); })
      .def_readonly("sample", &Solver::sample)
      .def_readonly("affine", &Solver::affine)
      .def_property_readonly("levelled", &Solver::levelled)
      .def_property_readonly("metric", &Solver::metric)
      .def_property_readonly("assumptions", &Solver::assumptions)
      .def_property_readonly("unknowns", [](const Solver& s) { return std::string(s.unknowns); })
      .def_property_readonly("unit", [](const Solver& s) { return std::string(s.unit); })
      .def_readonly("typical_ns", &Solver::typical_ns)
      .def_property_readonly("in_pool", [](const Solver& s) { return s.pool == PoolUse::kOn; })
      .def_property_readonly("max_poses", &capacity_of)
      .def_property_readonly("has_least_squares",
                             [](const Solver& s) { return s.run.least_squares != nullptr; })
      .def_property_readonly("has_planar", &has_planar)
      .def_property_readonly("doc", &docstring_of)
      .def("solve", &solve, py::arg("x1"), py::arg("x2"), py::arg("A") = py::none(),
           "The function of the solver's name: poses of one sample or of many.")
      .def("essentials", &essentials, py::arg("x1"), py::arg("x2"), py::arg("A") = py::none(),
           "(E, count): essential matrices, |E| = √2, of one sample (M, 3, 3) or many (N, M, 3, 3);"
           "\nzero beyond the count.")
      .def("least_squares", &least_squares, py::arg("x1"), py::arg("x2"), py::arg("A") = py::none(),
           "Poses of all correspondences together, (N, 2) and (N, 2, 2) with N ≥ sample.")
      .def("planar", &planar, py::arg("x1"), py::arg("x2"), py::arg("A") = py::none(),
           "PlanarPoses of each correspondence, (N, 2) and (N, 2, 2): the fastest form. Several at"
           "\na time where the list has such a form, equal to solve() within 1e-9.")
      .def("__repr__",
           [](const Solver& s) { return "<oneac.Solver " + std::string(s.name) + ">"; });
}

void bind_function(py::module_& m, const Solver& solver) {
  const std::string name(solver.name), doc = docstring_of(solver);
  const Solver* row = &solver;
  if (solver.affine) {
    m.def(
        name.c_str(),
        [row](const py::object& x1, const py::object& x2, const py::object& A) {
          return solve(*row, x1, x2, A);
        },
        doc.c_str(), py::arg("x1"), py::arg("x2"), py::arg("A"));
  } else {
    m.def(
        name.c_str(),
        [row](const py::object& x1, const py::object& x2) {
          return solve(*row, x1, x2, py::none());
        },
        doc.c_str(), py::arg("x1"), py::arg("x2"));
  }
}

}  // namespace

void bind_solvers(py::module_& m) {
  bind_row_class(m);
  m.def(
      "solvers",
      [] {
        std::vector<const Solver*> rows;
        for (const Solver& solver : solvers()) rows.push_back(&solver);
        return rows;
      },
      py::return_value_policy::reference, "Every solver, in the order of the documentation.");
  m.def("solver", &solver_named, py::arg("name"), py::return_value_policy::reference,
        "The solver of this name. ValueError when there is none.");
  py::options no_signatures;
  no_signatures.disable_function_signatures();
  for (const Solver& solver : solvers()) bind_function(m, solver);
}

}  // namespace oneac::python
