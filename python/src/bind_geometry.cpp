// Cameras, pixels to normalised coordinates, levelling, angular errors.
#include "arrays.h"
#include "bindings.h"

#include "oneac/geometry/angular_errors.h"
#include "oneac/geometry/camera.h"
#include "oneac/geometry/homography.h"
#include "oneac/geometry/levelling.h"
#include "oneac/observations/sensor_mount.h"
#include "oneac/rawlog/calibration.h"

#include <pybind11/stl.h>

#include <cmath>
#include <stdexcept>

namespace oneac::python {
namespace {

Eigen::Matrix3d matrix_of(const PinholeCamera& camera) {
  Eigen::Matrix3d K;
  K << camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1;
  return K;
}

/// The pinhole of a 3×3 K. @throws std::invalid_argument for a skew, or anything but fx fy cx cy 1
PinholeCamera camera_of(const py::object& K, const char* name) {
  const Eigen::Matrix3d M = matrix3(K, name);
  const bool plain = M(0, 1) == 0 && M(1, 0) == 0 && M.row(2) == Eigen::RowVector3d(0, 0, 1);
  if (!plain || !(M(0, 0) > 0) || !(M(1, 1) > 0)) {
    throw std::invalid_argument(std::string(name) +
                                " must be [[fx, 0, cx], [0, fy, cy], [0, 0, 1]] with fx, fy > 0");
  }
  PinholeCamera camera;
  camera.fx = M(0, 0);
  camera.fy = M(1, 1);
  camera.cx = M(0, 2);
  camera.cy = M(1, 2);
  return camera;
}

PinholeCamera camera_from(int width, int height, double fx, double fy, double cx, double cy,
                          const py::object& distortion, const std::string& lens) {
  PinholeCamera camera{width, height, fx, fy, cx, cy, {}, LensModel::plumb_bob};
  const Doubles given = numbers(distortion, "distortion", {-1});
  if (static_cast<std::size_t>(given.size()) > camera.distortion.size()) {
    throw std::invalid_argument("distortion has " + std::to_string(given.size()) +
                                " coefficients, must have at most 8");
  }
  std::copy_n(given.data(), given.size(), camera.distortion.begin());
  if (lens == "kannala_brandt") {
    camera.lens = LensModel::kannala_brandt;
  } else if (lens != "plumb_bob") {
    throw std::invalid_argument("lens = '" + lens + "', must be plumb_bob or kannala_brandt");
  }
  camera.validate();
  return camera;
}

const char* lens_of(const PinholeCamera& c) {
  return c.lens == LensModel::plumb_bob ? "plumb_bob" : "kannala_brandt";
}

/// All that a camera is: what it is made of again, compared by and hashed by.
py::tuple state_of(const PinholeCamera& c) {
  return py::make_tuple(c.width, c.height, c.fx, c.fy, c.cx, c.cy,
                        py::tuple(py::cast(c.distortion)), lens_of(c));
}

PinholeCamera camera_of_state(const py::tuple& state) {
  if (state.size() != 8) throw std::invalid_argument("this is no pickled oneac.Camera");
  const auto number = [&](std::size_t i) { return py::cast<double>(state[i]); };
  return camera_from(py::cast<int>(state[0]), py::cast<int>(state[1]), number(2), number(3),
                     number(4), number(5), state[6], py::cast<std::string>(state[7]));
}

void bind_values(py::class_<PinholeCamera>& camera) {
  camera
      .def(
          "__eq__",
          [](const PinholeCamera& a, const PinholeCamera& b) {
            return state_of(a).equal(state_of(b));
          },
          py::is_operator())
      .def("__hash__", [](const PinholeCamera& c) { return py::hash(state_of(c)); })
      .def(py::pickle(&state_of, &camera_of_state));
}

void bind_camera(py::module_& m) {
  py::class_<PinholeCamera> camera(
      m, "Camera", "A pinhole camera and its lens, pixel centres at integers [px].");
  bind_values(camera);
  camera
      .def(py::init(&camera_from), py::arg("width"), py::arg("height"), py::arg("fx"),
           py::arg("fy"), py::arg("cx"), py::arg("cy"), py::arg("distortion") = py::tuple(),
           py::arg("lens") = "plumb_bob",
           "distortion: k1 k2 p1 p2 k3 k4 k5 k6 of plumb_bob, k1 … k4 of kannala_brandt; none:\n"
           "rectified images. ValueError naming what is out of bounds.")
      .def_static("load", &load_calibration, py::arg("file"), py::arg("side") = "",
                  "From FILE or FILE:SECTION, of any kind that `oneac run --calibration` reads.")
      .def_readonly("width", &PinholeCamera::width)
      .def_readonly("height", &PinholeCamera::height)
      .def_property_readonly(
          "K", [](const PinholeCamera& c) { return to_numpy(Eigen::MatrixXd(matrix_of(c))); })
      .def_property_readonly("focal_px", &PinholeCamera::focal_px)
      .def_readonly("distortion", &PinholeCamera::distortion)
      .def_property_readonly("lens", &lens_of)
      .def("__repr__", [](const PinholeCamera& c) {
        return "<oneac.Camera " + std::to_string(c.width) + "x" + std::to_string(c.height) +
               ", f = " + std::to_string(c.focal_px()) + " px>";
      });
}

/// x1, x2, A as arrays of the input's shape.
struct AcOutput {
  explicit AcOutput(const AcInput& like)
      : x1(with(like.shape(), {2})), x2(with(like.shape(), {2})), A(with(like.shape(), {2, 2})) {}

  static Shape with(Shape shape, std::initializer_list<py::ssize_t> more) {
    shape.insert(shape.end(), more);
    return shape;
  }
  void put(std::size_t i, const AffineCorrespondence& ac) {
    using RowMajor2 = Eigen::Matrix<double, 2, 2, Eigen::RowMajor>;
    Eigen::Map<Eigen::Vector2d>(x1.mutable_data() + 2 * i) = ac.x1;
    Eigen::Map<Eigen::Vector2d>(x2.mutable_data() + 2 * i) = ac.x2;
    Eigen::Map<RowMajor2>(A.mutable_data() + 4 * i) = ac.A;
  }

  Doubles x1, x2, A;
};

py::tuple normalise_arrays(const py::object& u1, const py::object& u2, const py::object& A,
                           const py::object& K1, const py::object& K2) {
  const PinholeCamera first = camera_of(K1, "K1");
  const PinholeCamera second = K2.is_none() ? first : camera_of(K2, "K2");
  const AcInput input(u1, u2, A, false);
  input.require_finite(0, input.size());
  AcOutput output(input);
  AffineCorrespondence ac;
  for (std::size_t i = 0; i < input.size(); ++i) {
    input.load(i, 1, &ac);
    output.put(i, normalise(ac, first, second));
  }
  return py::make_tuple(output.x1, output.x2, output.A);
}

py::tuple rotate_arrays(const py::object& x1, const py::object& x2, const py::object& A,
                        const py::object& Q1, const py::object& Q2) {
  const Eigen::Matrix3d first = rotation(Q1, "Q1");
  const Eigen::Matrix3d second = Q2.is_none() ? first : rotation(Q2, "Q2");
  const AcInput input(x1, x2, A, false);
  input.require_finite(0, input.size());
  AcOutput output(input);
  AffineCorrespondence ac;
  for (std::size_t i = 0; i < input.size(); ++i) {
    input.load(i, 1, &ac);
    const auto turned = rotate_views(ac, first, second);
    if (!turned) {
      throw std::invalid_argument("correspondence " + std::to_string(i) +
                                  " leaves the half-space before its rotated camera");
    }
    output.put(i, *turned);
  }
  return py::make_tuple(output.x1, output.x2, output.A);
}

Doubles mount(double roll_right_deg, double pitch_up_deg, double yaw_left_deg,
              const py::object& position) {
  const MountAngles angles{roll_right_deg, pitch_up_deg, yaw_left_deg};
  angles.validate();
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = mount_rotation(angles);
  if (!position.is_none()) T.translation() = vector3(position, "position");
  return to_numpy(T);
}

Doubles levelling(double pitch_up, double roll_right) {
  if (!std::isfinite(pitch_up) || !std::isfinite(roll_right)) {
    throw std::invalid_argument("pitch_up and roll_right must be finite");
  }
  return to_numpy(Eigen::MatrixXd(levelling_rotation({pitch_up, roll_right})));
}

void bind_errors_of_angles(py::module_& m) {
  m.def(
      "rotation_error",
      [](const py::object& R, const py::object& R_ref) {
        return rotation_error(matrix3(R, "R"), matrix3(R_ref, "R_ref"));
      },
      py::arg("R"), py::arg("R_ref"), "Angle of R R_refᵀ [rad], accurate near zero.");
  m.def(
      "direction_error",
      [](const py::object& t, const py::object& t_ref) {
        return direction_error(vector3(t, "t"), vector3(t_ref, "t_ref"));
      },
      py::arg("t"), py::arg("t_ref"),
      "Angle between two directions [rad], 0…π; the sign counts. π/2 when either has no length.");
}

}  // namespace

void bind_geometry(py::module_& m) {
  bind_camera(m);
  bind_errors_of_angles(m);
  m.def("normalise", &normalise_arrays, py::arg("u1"), py::arg("u2"), py::arg("A"), py::arg("K1"),
        py::arg("K2") = py::none(),
        "(x1, x2, A) in normalised coordinates out of pixels: x = K⁻¹ u, A = K2'⁻¹ A_px K1'.\n\n"
        "u1, u2: (…, 2) [px]; A: (…, 2, 2) or None (then the identity); K1, K2: (3, 3) without "
        "skew;\nK2 as K1 unless given.");
  m.def("rotate_views", &rotate_arrays, py::arg("x1"), py::arg("x2"), py::arg("A"), py::arg("Q1"),
        py::arg("Q2") = py::none(),
        "(x1, x2, A) as cameras rotated about their centres see them: a ray r1 becomes Q1 r1, a\n"
        "ray r2 Q2 r2 (Q1 unless given). With levelling_rotation() it makes the input of solvers\n"
        "that assume Y along gravity; R_level, t_level of theirs are Qᵀ R_level Q, Qᵀ t_level of\n"
        "the tilted cameras.");
  m.def("levelling_rotation", &levelling, py::arg("pitch_up"), py::arg("roll_right"),
        "R_level_cam (3, 3): rotates a ray of the tilted camera into the levelled one.\n\n"
        "pitch_up [rad]: positive when the optical axis points above the horizon;\n"
        "roll_right [rad]: positive when the camera leans to its right.");
  m.def("mount", &mount, py::arg("roll_right_deg") = 0.0, py::arg("pitch_up_deg") = 0.0,
        py::arg("yaw_left_deg") = 0.0, py::arg("position") = py::none(),
        "T_vehicle_cam (4, 4) of a camera (X right, Y down, Z forward) on a vehicle (X forward,\n"
        "Y left, Z up); position in the vehicle [m].");
}

}  // namespace oneac::python
