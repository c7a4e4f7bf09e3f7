// The front-end, fed with images of numpy or frames of a rawlog.
#include "bindings.h"
#include "front_end_records.h"
#include "options.h"
#include "records.h"
#include "words.h"

#include "oneac/evaluation/relative_poses_io.h"
#include "oneac/frontend/front_end.h"
#include "oneac/frontend/trajectory_uncertainty.h"

#include <pybind11/stl.h>

#include <mutex>
#include <optional>
#include <stdexcept>

namespace oneac::python {
namespace {

/// A front-end with what it needs to make observations of bare images. Calls of several threads go
/// one by one; the lock is only taken without the interpreter's.
class LiveFrontEnd {
  template <class Work>
  auto alone(Work&& work) {
    return told_in_python(Asked::kFrontEnd, [&] {
      const py::gil_scoped_release release;
      const std::lock_guard<std::mutex> lock(mutex_);
      return work();
    });
  }

 public:
  LiveFrontEnd(const FrontEndOptions& options, const Eigen::Isometry3d& mount, int threads)
      : front_end_(options, threads), mount_(mount), calibrated_(options.calibration.has_value()) {
    front_end_.logging_enable_console_output = false;
    front_end_.logRegisterCallback([](std::string_view text, mrpt::system::VerbosityLevel level,
                                      std::string_view,
                                      mrpt::Clock::time_point) { log_to_python(text, level); });
  }

  py::object feed(const py::object& image, double time_s, const py::object& mask) {
    if (!calibrated_) {
      throw std::invalid_argument("images need a camera: oneac.FrontEnd(camera, …)");
    }
    require_time(time_s);
    const auto observation = observation_of(pixels_from(image, true), time_s, mount_);
    Pixels used;
    ImageMasks masks;
    if (!mask.is_none()) {
      used = pixels_from(mask, false, "mask");
      masks.image = view_of(used);
    }
    const auto result = alone([&] { return front_end_.feed(observation, masks); });
    if (!result) return py::none();
    remember(*result);
    return python::to_python(*result);
  }

  py::object process(const CameraFrame& frame) {
    const FrameResult result = alone([&] { return front_end_.process(front_end_.prepare(frame)); });
    remember(result);
    return python::to_python(result);
  }

  void add_speed(double time_s, double speed, double sigma) {
    alone([&] { front_end_.add_speed(time_s, speed, sigma); });
  }
  void add_acceleration(double time_s, const py::object& acceleration,
                        std::optional<double> yaw_rate) {
    const Eigen::Vector3d a = vector3(acceleration, "acceleration");
    alone([&] { front_end_.add_acceleration(time_s, a, yaw_rate); });
  }
  void add_yaw_rate(double time_s, double yaw_rate) {
    alone([&] { front_end_.add_yaw_rate(time_s, yaw_rate); });
  }
  void add_course(double time_s, double course, double speed) {
    alone([&] { front_end_.add_course(time_s, course, speed); });
  }
  void finish() {
    alone([&] { static_cast<void>(front_end_.finish()); });
  }

  [[nodiscard]] py::object trajectory() {
    return python::to_python(alone([&] {
      Trajectory trajectory;
      for (const FramePose& pose : front_end_.trajectory().poses()) {
        trajectory.times.push_back(pose.time_s);
        trajectory.poses.push_back(pose.T_first_cam);
      }
      return trajectory;
    }));
  }
  [[nodiscard]] py::object relative_poses() const { return python::to_python(rows_); }
  [[nodiscard]] py::object correspondences() {
    const TrackedPair pair = alone([&] { return front_end_.correspondences(); });
    return columns_of(pair);
  }
  [[nodiscard]] py::object car_mask() {
    const GreyImage mask = alone([&] { return front_end_.car_mask(); });
    return mask.empty() ? py::object(py::none()) : py::object(python::to_numpy(mask));
  }
  [[nodiscard]] std::vector<std::string> setup_faults() {
    std::vector<std::string> faults = alone([&] { return front_end_.setup_faults(); });
    for (std::string& fault : faults) fault = in_python(fault, Asked::kFrontEnd);
    return faults;
  }
  [[nodiscard]] py::object tilt() {
    return python::to_python(alone([&] { return front_end_.tilt_belief(); }));
  }
  [[nodiscard]] py::object camera_belief() {
    return python::to_python(alone([&] { return front_end_.camera_belief(); }));
  }
  /// What one of the front-end's functions says.
  template <auto kFunction>
  [[nodiscard]] auto said() {
    return alone([&] { return (front_end_.*kFunction)(); });
  }

 private:
  void remember(const FrameResult& result) {
    if (result.step) rows_.push_back(row_of(*result.step, sigma_of_length(*result.step)));
  }

  static py::object columns_of(const TrackedPair& pair);

  std::mutex mutex_;
  FrontEnd front_end_;
  Eigen::Isometry3d mount_;
  bool calibrated_;
  std::vector<RelativePoseRow> rows_;
};

py::object LiveFrontEnd::columns_of(const TrackedPair& pair) {
  const std::vector<AffineCorrespondence> acs = affine_parts(pair);
  const auto two = [&](const Eigen::Vector2d AffineCorrespondence::*point) {
    return rows_of(acs, 2, [&](const AffineCorrespondence& ac) {
      return std::optional<Eigen::Vector2d>(ac.*point);
    });
  };
  Doubles A(Shape{static_cast<py::ssize_t>(acs.size()), 2, 2});
  for (std::size_t i = 0; i < acs.size(); ++i) {
    Eigen::Map<Eigen::Matrix<double, 2, 2, Eigen::RowMajor>>(A.mutable_data() + 4 * i) = acs[i].A;
  }
  return result_class("Correspondences")(two(&AffineCorrespondence::x1),
                                         two(&AffineCorrespondence::x2), A);
}

std::unique_ptr<LiveFrontEnd> front_end_from(const py::object& camera,
                                             const py::object& T_vehicle_cam, std::size_t seed,
                                             int threads, const py::kwargs& values) {
  FrontEndOptions options;
  ParameterTable table;
  table.add("", options);
  set_parameters(values, "", table);
  options.seed = seed;
  options.mount_convention = "optical";
  if (!camera.is_none() && !py::isinstance<PinholeCamera>(camera)) {
    throw std::invalid_argument("camera must be an oneac.Camera");
  }
  if (!camera.is_none()) options.calibration = py::cast<PinholeCamera>(camera);
  options.validate();
  const Eigen::Isometry3d mount = T_vehicle_cam.is_none() ? CameraFrame::forward_looking_mount()
                                                          : rigid(T_vehicle_cam, "T_vehicle_cam");
  if (threads < 1) {
    throw std::invalid_argument("threads = " + std::to_string(threads) + ", must be at least 1");
  }
  return std::make_unique<LiveFrontEnd>(options, mount, threads);
}

constexpr const char* kFrontEndDoc =
    R"(Frame in, pose out: the visual front-end of a vehicle with one camera.

FrontEnd(camera, camera_height=1.65) takes numpy images by feed(); FrontEnd() frames of a Rawlog by
process(). Further keywords are the keys of front_end in docs/parameters.md, sections as dicts:
initialiser="1ac_ground", tilt={"source": "drive"}.

camera         Camera of the images that feed() gets; with distortion it removes that.
T_vehicle_cam  (4, 4) pose of the camera on the vehicle (oneac.mount); None: level, looking ahead.
seed           Of methods that draw random numbers.
threads        That share the work of an image, the caller among them; they change no result.

Poses are metric only where they say so. Calls release the interpreter's lock; those of several
threads go one by one. Notes go to logging.getLogger("oneac").)";

void bind_numbers(py::class_<LiveFrontEnd>& front_end) {
  using Self = LiveFrontEnd;
  front_end
      .def_property_readonly("camera_height", &Self::said<&FrontEnd::camera_height>,
                             "[m] in use; 0: unknown, then nothing is metric.")
      .def_property_readonly("length_doubt", &Self::said<&FrontEnd::length_doubt>,
                             "Relative 1σ that lengths have for what bends say of the camera.")
      .def_property_readonly("scale_uncertainty", &Self::said<&FrontEnd::scale_uncertainty>,
                             "Relative 1σ of the map's lengths; infinite while nobody told them.")
      .def_property_readonly("stamps_are_wrong", &Self::said<&FrontEnd::stamps_are_wrong>,
                             "Lengths would need accelerations that no car has.")
      .def_property_readonly("car_mask_refused", &Self::said<&FrontEnd::car_mask_refused>,
                             "Half of the image looked like the car: nothing is masked.");
}

}  // namespace

void bind_front_end(py::module_& m) {
  using Self = LiveFrontEnd;
  py::class_<Self> front_end(m, "FrontEnd", kFrontEndDoc);
  front_end
      .def(py::init(&front_end_from), py::arg("camera") = py::none(), py::kw_only(),
           py::arg("T_vehicle_cam") = py::none(), py::arg("seed") = 0, py::arg("threads") = 1)
      .def("feed", &Self::feed, py::arg("image"), py::arg("time_s"), py::arg("mask") = py::none(),
           "An image (height, width) grey or (height, width, 3) RGB, uint8, at a Unix time [s].\n"
           "mask: (height, width) uint8, below 128 where pixels are not used.\n"
           "FrameResult; None for one that is not later than the last, or repeats it.")
      .def("process", &Self::process, py::arg("frame"),
           "A Frame, in order of time: FrameResult, as `oneac run` has it.")
      .def("add_speed", &Self::add_speed, py::arg("time_s"), py::arg("speed"),
           py::arg("sigma") = SpeedReading::kDoppler,
           "Speed over ground [m/s] with its 1σ, for scale={\"source\": \"gps\"}; a second or two\n"
           "ahead of the images.")
      .def("add_acceleration", &Self::add_acceleration, py::arg("time_s"), py::arg("acceleration"),
           py::arg("yaw_rate") = py::none(),
           "Specific force (3,) in the vehicle frame [m/s²], yaw rate [rad/s], for\n"
           "tilt={\"source\": \"imu\"}.")
      .def("add_yaw_rate", &Self::add_yaw_rate, py::arg("time_s"), py::arg("yaw_rate"),
           "Yaw rate [rad/s], counter-clockwise, for calibration={\"refine\": \"focal\"}.")
      .def("add_course", &Self::add_course, py::arg("time_s"), py::arg("course"), py::arg("speed"),
           "Course over ground [rad], clockwise from north, and speed [m/s], for\n"
           "calibration={\"refine\": \"focal\"}.")
      .def("finish", &Self::finish, "Makes everything final at the end of a drive.")
      .def_property_readonly("trajectory", &Self::trajectory,
                             "Trajectory of the camera in its first frame; final after finish().")
      .def_property_readonly("relative_poses", &Self::relative_poses,
                             "RelativePoses of the pairs so far, as relative_poses.csv has them.")
      .def_property_readonly("correspondences", &Self::correspondences,
                             "Correspondences [px] from the frame before to the last one.")
      .def_property_readonly(
          "car_mask", &Self::car_mask,
          "(height, width) uint8, 0 where the car itself is seen; None: nowhere.")
      .def_property_readonly("setup_faults", &Self::setup_faults,
                             "What speaks against calibration and mount, a line each; while there\n"
                             "is something, no step is metric.")
      .def_property_readonly("tilt", &Self::tilt, "TiltBelief: how the camera looks, as of now.")
      .def_property_readonly("camera_belief", &Self::camera_belief,
                             "CameraBelief: what the drive says of the focal length.");
  bind_numbers(front_end);
}

}  // namespace oneac::python
