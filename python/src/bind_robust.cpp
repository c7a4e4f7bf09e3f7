// Both robust estimators and the initialisers, by name.
#include "arrays.h"
#include "bindings.h"
#include "options.h"

#include "oneac/initialisers/initialiser_options.h"
#include "oneac/initialisers/relative_pose_initialiser.h"
#include "oneac/robust/gc_ransac.h"
#include "oneac/robust/one_ac_consensus.h"
#include "oneac/solvers/registry.h"

#include <mrpt/containers/yaml.h>
#include <pybind11/stl.h>

#include <cmath>
#include <set>
#include <stdexcept>

namespace oneac::python {
namespace {

py::object to_python(const std::optional<MotionEvidence>& motion) {
  if (!motion) return py::none();
  return result_class("MotionEvidence")(to_string(motion->model), motion->log_odds, motion->length,
                                        motion->length_sigma);
}

py::object to_python(const RobustResult& result) {
  py::array_t<bool> inliers(static_cast<py::ssize_t>(result.inliers.size()));
  std::copy(result.inliers.begin(), result.inliers.end(), inliers.mutable_data());
  const RobustStatistics& work = result.statistics;
  return result_class("RobustResult")(
      to_string(result.status), to_numpy(Eigen::MatrixXd(result.pose.R)), to_numpy(result.pose.t),
      inliers, result.cost, to_numpy(Eigen::MatrixXd(result.covariance)), to_python(result.motion),
      result.inlier_count, work.iterations, work.hypotheses, work.local_optimisations,
      work.graph_cuts);
}

/// @throws std::invalid_argument for another shape than (N, 2)
AcInput pair_from(const py::object& x1, const py::object& x2, const py::object& A, bool affine) {
  AcInput input(x1, x2, A, affine);
  if (input.shape().size() != 1) {
    Shape shape = input.shape();
    shape.push_back(2);
    throw std::invalid_argument("x1 has shape " + text_of(shape) + ", must have (N, 2)");
  }
  return input;
}

void require_focal(double focal_px) {
  if (!(focal_px > 0.0) || !std::isfinite(focal_px)) {
    throw std::invalid_argument("focal_px = " + std::to_string(focal_px) +
                                ", must be above 0 and finite");
  }
}

double number_of(const py::dict& values, const char* key, double otherwise) {
  return values.contains(key) ? py::cast<double>(values[key]) : otherwise;
}

MotionPrior prior_from(const py::object& given) {
  MotionPrior prior;
  if (given.is_none()) return prior;
  const py::dict values(given);
  static const std::set<std::string> kKeys{"direction", "direction_sigma", "length",
                                           "length_sigma"};
  for (const auto& [key, value] : values) {
    const std::string name = py::cast<std::string>(py::str(key));
    if (kKeys.count(name) == 0) {
      throw std::invalid_argument("prior has no '" + name +
                                  "', must be direction, direction_sigma, length or length_sigma");
    }
  }
  if (values.contains("direction")) prior.direction = vector3(values["direction"], "direction");
  prior.direction_sigma = number_of(values, "direction_sigma", prior.direction_sigma);
  prior.length = number_of(values, "length", prior.length);
  prior.length_sigma = number_of(values, "length_sigma", prior.length_sigma);
  prior.validate();
  return prior;
}

py::object consensus(const py::object& x1, const py::object& x2, const py::object& A,
                     double focal_px, const py::object& R_level_cam, const py::object& prior,
                     const py::kwargs& values) {
  const auto options = options_from<ConsensusOptions>(values);
  require_focal(focal_px);
  const auto acs = pair_from(x1, x2, A, true).all();
  const Eigen::Matrix3d R = rotation(R_level_cam, "R_level_cam");
  const MotionPrior known = prior_from(prior);
  RobustResult result;
  {
    const py::gil_scoped_release release;
    result = one_ac_consensus(acs, R, focal_px, options, known);
  }
  return to_python(result);
}

py::object graph_cut_ransac(const std::string& solver, const py::object& x1, const py::object& x2,
                            const py::object& A, double focal_px, const py::object& R_level_cam,
                            std::uint64_t seed, const py::kwargs& values) {
  const auto options = options_from<GcRansacOptions>(values);
  const Solver& row = solver_named(solver);
  require_focal(focal_px);
  const auto acs = pair_from(x1, x2, A, row.affine).all();
  const Eigen::Matrix3d R = rotation(R_level_cam, "R_level_cam");
  RobustResult result;
  {
    const py::gil_scoped_release release;
    result = gc_ransac(acs, R, focal_px, row, seed, options);
  }
  return to_python(result);
}

RelativePoseInitialiser::Ptr initialiser(const std::string& name, const py::kwargs& values) {
  const auto options = options_from<InitialiserOptions>(values);
  auto made = make_initialiser(name);
  made->logging_enable_console_output = false;
  made->configure(mrpt::containers::yaml::FromText(options.to_yaml()));
  return made;
}

/// Affinities are needed by every method: they tell rest from travel, and the identity that stands
/// for a bare point would say rest.
py::object estimate(const RelativePoseInitialiser& method, const py::object& x1,
                    const py::object& x2, const py::object& A, double focal_px,
                    const py::object& R_level_cam, std::uint64_t seed, const py::object& prior) {
  require_focal(focal_px);
  const auto acs = pair_from(x1, x2, A, true).all();
  const Eigen::Matrix3d R = rotation(R_level_cam, "R_level_cam");
  const MotionPrior known = prior_from(prior);
  RobustResult result;
  {
    const py::gil_scoped_release release;
    result = method.estimate({acs, R, focal_px, seed, known});
  }
  return to_python(result);
}

void bind_initialiser(py::module_& m) {
  py::class_<RelativePoseInitialiser, RelativePoseInitialiser::Ptr>(
      m, "Initialiser", "A relative-pose method of `oneac run --initialiser`, by name.")
      .def(py::init(&initialiser), py::arg("name"),
           "Options are those of the parameters' sections: estimator=\"gc_ransac\",\n"
           "consensus={\"threshold_px\": 2}, gc_ransac={…}. InputError for a name that does not\n"
           "exist, ValueError for an option.")
      .def_property_readonly("name", &RelativePoseInitialiser::name)
      .def_property_readonly("estimators", &RelativePoseInitialiser::estimators)
      .def("estimate", &estimate, py::arg("x1"), py::arg("x2"), py::arg("A"), py::kw_only(),
           py::arg("focal_px"), py::arg("R_level_cam") = py::none(), py::arg("seed") = 0,
           py::arg("prior") = py::none(),
           "RobustResult of one pair; arguments as of one_ac_consensus() and gc_ransac().")
      .def("__repr__", [](const RelativePoseInitialiser& method) {
        return "<oneac.Initialiser " + method.name() + ">";
      });
  m.def("initialiser_names", &initialiser_names, "Short names of all initialisers, sorted.");
}

constexpr const char* kConsensusDoc =
    R"(Relative pose by the exhaustive one-AC consensus, without a random number.

Hypotheses of every correspondence are scored by MSAC on the Sampson distance, the best polished
with five degrees of freedom; robust/one_ac_consensus.h, docs/decisions/consensus.md.

Parameters
----------
x1, x2 : (N, 2)    Normalised points [-] of the camera as it is mounted (tilted).
A : (N, 2, 2)      Affinity ∂x2/∂x1 [-].
focal_px           What turns pixels of options into normalised units [px].
R_level_cam        (3, 3), removes the camera's tilt (levelling_rotation); None: level.
prior              dict of direction (3,), direction_sigma [rad], length, length_sigma [camera
                   heights]: what is known of the motion; None: nothing.
options            Keys of front_end.consensus in docs/parameters.md, e.g. threshold_px=1.0.

Returns a RobustResult; ValueError for shapes, numbers that are not finite, options.)";

constexpr const char* kGcRansacDoc =
    R"(Relative pose by Graph-Cut RANSAC (Barath and Matas, CVPR 2018) with any solver of the list.

Parameters
----------
solver             Name of a solver, e.g. "essential_5pc" (oneac.solvers()).
x1, x2 : (N, 2)    Normalised points [-] of the camera as it is mounted (tilted).
A : (N, 2, 2)      Affinity ∂x2/∂x1 [-]; None will do for solvers of points.
focal_px           What turns pixels of options into normalised units [px].
R_level_cam        (3, 3), removes the camera's tilt for planar solvers; None: level.
seed               Same input, seed and options: same bits.
options            Keys of front_end.gc_ransac in docs/parameters.md, e.g. threshold_px=1.0.

Returns a RobustResult; ValueError for shapes, numbers that are not finite, options.)";

}  // namespace

void bind_robust(py::module_& m) {
  m.def("one_ac_consensus", &consensus, kConsensusDoc, py::arg("x1"), py::arg("x2"), py::arg("A"),
        py::kw_only(), py::arg("focal_px"), py::arg("R_level_cam") = py::none(),
        py::arg("prior") = py::none());
  m.def("gc_ransac", &graph_cut_ransac, kGcRansacDoc, py::arg("solver"), py::arg("x1"),
        py::arg("x2"), py::arg("A") = py::none(), py::kw_only(), py::arg("focal_px"),
        py::arg("R_level_cam") = py::none(), py::arg("seed") = 0);
  bind_initialiser(m);
}

}  // namespace oneac::python
