// Rawlogs: images of one camera as frames, GPS and IMU as arrays.
#include "bindings.h"
#include "frames.h"
#include "records.h"
#include "words.h"

#include "oneac/rawlog/log_summary.h"
#include "oneac/rawlog/rawlog_source.h"
#include "oneac/rawlog/vehicle_reference.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

namespace oneac::python {
namespace {

/// A log that is being read, once. One reader at a time: the lock is taken without the
/// interpreter's.
class Pass {
 public:
  explicit Pass(const SourceOptions& options) : source_(options) {}

  /// The next frame. @throws py::stop_iteration after the last
  std::shared_ptr<CameraFrame> next() {
    auto frame = told_in_python(Asked::kRawlog, [this] { return read(); });
    if (!frame) throw py::stop_iteration();
    return frame;
  }
  [[nodiscard]] SourceReport report() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return source_.report();
  }
  [[nodiscard]] std::vector<SpeedReading> take_wheels() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return std::exchange(wheels_, {});
  }

 private:
  /// Null after the last.
  std::shared_ptr<CameraFrame> read() {
    const py::gil_scoped_release release;
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto ticket = source_.next();
    if (ticket) {
      wheels_.insert(wheels_.end(), ticket->wheels.begin(), ticket->wheels.end());
      return std::make_shared<CameraFrame>(source_.load(*ticket));
    }
    if (!finished_) source_.finish();
    finished_ = true;
    return nullptr;
  }

  std::mutex mutex_;
  RawlogSource source_;
  std::vector<SpeedReading> wheels_;  ///< that nobody has taken yet
  bool finished_ = false;
};

/// A log, and the newest pass over it. Its own members are guarded by the interpreter's lock.
class Rawlog {
 public:
  explicit Rawlog(const SourceOptions& options) : options_(options), newest_(begun()) {}

  /// From the first image on; the pass that opening the log began is not begun twice.
  std::shared_ptr<Pass> iterate() {
    if (std::exchange(untouched_, false)) return newest_;
    newest_ = begun();
    return newest_;
  }
  /// Goes on with the newest pass.
  std::shared_ptr<CameraFrame> next() {
    untouched_ = false;
    return std::shared_ptr(newest_)->next();
  }
  [[nodiscard]] Pass& newest() { return *newest_; }

 private:
  [[nodiscard]] std::shared_ptr<Pass> begun() const {
    return told_in_python(Asked::kRawlog, [this] {
      const py::gil_scoped_release release;
      options_.validate();
      return std::make_shared<Pass>(options_);
    });
  }

  SourceOptions options_;
  std::shared_ptr<Pass> newest_;
  bool untouched_ = true;  ///< nobody has read from the newest pass
};

std::unique_ptr<Rawlog> open(const std::filesystem::path& log, const std::string& camera,
                             const std::optional<std::filesystem::path>& images_dir,
                             const py::object& calibration, std::size_t first, std::size_t count,
                             std::size_t every, bool stereo, const std::string& convention,
                             const std::optional<std::filesystem::path>& mask_dir,
                             const std::optional<std::array<double, 3>>& mount_deg,
                             double undistorted_fov_deg) {
  SourceOptions options;
  options.log = log;
  options.camera = camera;
  if (images_dir) options.images_dir = *images_dir;
  options.mount_convention = convention;
  options.first = first;
  options.count = count;
  options.every = every;
  options.stereo = stereo;
  if (mask_dir) options.mask_dir = *mask_dir;
  if (mount_deg) {
    options.mount = MountAngles{(*mount_deg)[0], (*mount_deg)[1], (*mount_deg)[2]};
    options.mount->validate();
  }
  options.undistorted_fov_deg = undistorted_fov_deg;
  if (py::isinstance<PinholeCamera>(calibration)) {
    options.camera_model = py::cast<PinholeCamera>(calibration);
  } else if (!calibration.is_none()) {
    options.calibration = py::cast<std::string>(py::str(calibration));
  }
  return std::make_unique<Rawlog>(options);
}

py::object report_of(Rawlog& log) {
  const SourceReport report = log.newest().report();
  return result_class("RawlogReport")(
      report.images_in_log, report.images_missing, report.first_missing, report.pairs_delivered,
      report.damage, report.first_lone, report.names_out_of_order, report.wheel_readings,
      report.calibration_scaled, report.undistorted_by_log);
}

py::object speeds_of(Rawlog& log) {
  const std::vector<SpeedReading> told = log.newest().take_wheels();
  return result_class("Speeds")(
      column<double>(told, [](const SpeedReading& reading) { return reading.time_s; }),
      column<double>(told, [](const SpeedReading& reading) { return reading.speed; }),
      column<double>(told, [](const SpeedReading& reading) { return reading.sigma; }));
}

py::object gps_columns(const std::vector<GpsFix>& gps) {
  return result_class("Gps")(
      column<double>(gps, [](const GpsFix& fix) { return fix.time_s; }),
      rows_of(gps, 3, [](const GpsFix& fix) { return fix.position_enu; }),
      column<double>(gps, [](const GpsFix& fix) { return fix.speed.value_or(kAbsent); }),
      column<double>(gps, [](const GpsFix& fix) { return fix.course.value_or(kAbsent); }));
}

py::object imu_columns(const std::vector<ImuSample>& imu) {
  return result_class("Imu")(
      column<double>(imu, [](const ImuSample& sample) { return sample.time_s; }),
      rows_of(imu, 3, [](const ImuSample& sample) { return sample.acceleration; }),
      rows_of(imu, 3, [](const ImuSample& sample) { return sample.angular_rate; }));
}

py::object sensors(const std::filesystem::path& log) {
  VehicleReference reference;
  {
    const py::gil_scoped_release release;
    reference = read_vehicle_reference(log);
  }
  return result_class("Sensors")(gps_columns(reference.gps), imu_columns(reference.imu));
}

std::string describe(const std::filesystem::path& log) {
  const py::gil_scoped_release release;
  SummaryOptions options;
  options.log = log;
  return to_text(summarise_log(options));
}

/// A view of a frame's pixels, kept alive by it; None where there are none.
py::object pixels(const std::shared_ptr<CameraFrame>& frame, const GreyImage& image) {
  if (image.empty()) return py::none();
  const ImageView view = image.view();
  py::array_t<std::uint8_t> array(Shape{view.height, view.width}, Shape{view.stride, 1}, view.data,
                                  py::cast(frame));
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

std::shared_ptr<CameraFrame> made_frame(const py::object& image, double time_s,
                                        const PinholeCamera& camera, std::size_t index,
                                        const py::object& T_vehicle_cam, const py::object& mask,
                                        const py::object& right, const py::object& right_mask,
                                        double baseline_m) {
  return frame_from(image, time_s, camera, index, T_vehicle_cam,
                    {mask, right, right_mask, baseline_m});
}

void bind_frame(py::module_& m) {
  using Frame = std::shared_ptr<CameraFrame>;
  py::class_<CameraFrame, Frame>(m, "Frame", "One rectified image of one camera.")
      .def(py::init(&made_frame), py::arg("image"), py::arg("time_s"), py::arg("camera"),
           py::arg("index") = 0, py::arg("T_vehicle_cam") = py::none(), py::kw_only(),
           py::arg("mask") = py::none(), py::arg("right") = py::none(),
           py::arg("right_mask") = py::none(), py::arg("baseline_m") = 0.0,
           "image: (height, width) uint8 without distortion, of the camera's size; time_s: [s].\n"
           "right: the same of a camera baseline_m [m] to the right, rectified with it, for\n"
           "scale={\"source\": \"stereo\"}; masks: below 128 where pixels are not used.")
      .def_readonly("index", &CameraFrame::index)
      .def_readonly("time_s", &CameraFrame::time_s)
      .def_readonly("name", &CameraFrame::name)
      .def_readonly("camera", &CameraFrame::camera)
      .def_readonly("raw_camera", &CameraFrame::raw_camera)
      .def_readonly("baseline_m", &CameraFrame::baseline_m)
      .def_property_readonly("image", [](const Frame& f) { return pixels(f, f->image); })
      .def_property_readonly("mask", [](const Frame& f) { return pixels(f, f->mask); })
      .def_property_readonly("right", [](const Frame& f) { return pixels(f, f->right); })
      .def_property_readonly("right_mask", [](const Frame& f) { return pixels(f, f->right_mask); })
      .def_property_readonly("T_vehicle_cam",
                             [](const Frame& f) { return to_numpy(f->T_vehicle_cam); })
      .def("__repr__", [](const Frame& f) {
        return "<oneac.Frame " + std::to_string(f->index) + " " + f->name + ">";
      });
}

void bind_log(py::module_& m) {
  py::class_<Pass, std::shared_ptr<Pass>>(m, "RawlogIterator", "One pass over a Rawlog.")
      .def("__iter__", [](py::object self) { return self; })
      .def("__next__", &Pass::next);
  py::class_<Rawlog>(m, "Rawlog", "The images of one camera of an MRPT rawlog, in log order.")
      .def(py::init(&open), py::arg("log"), py::kw_only(), py::arg("camera") = "",
           py::arg("images_dir") = py::none(), py::arg("calibration") = py::none(),
           py::arg("first") = 0, py::arg("count") = 0, py::arg("every") = 1,
           py::arg("stereo") = false, py::arg("mount_convention") = "auto",
           py::arg("mask_dir") = py::none(), py::arg("mount_deg") = py::none(),
           py::arg("undistorted_fov_deg") = 0.0,
           "As the flags of `oneac run`; calibration: FILE[:SECTION] or a Camera; mount_deg: roll\n"
           "to the right, pitch up and yaw to the left [deg], instead of the log's. Streams: "
           "memory\n"
           "does not grow with the log. InputError: where, fault, cure.\n"
           "Each iter(), so each for, begins at the first image again; next(), take_wheels() and\n"
           "report are those of the newest pass.")
      .def("__iter__", &Rawlog::iterate)
      .def("__next__", &Rawlog::next)
      .def("take_wheels", &speeds_of,
           "Speeds by the log's odometer that became known since the last call, for\n"
           "FrontEnd.add_speed() with scale={\"source\": \"wheels\"}.")
      .def_property_readonly("report", &report_of,
                             "What was read so far: oneac.RawlogReport. A log that ends in damage\n"
                             "gives its frames before that; `damage` says so then.");
}

}  // namespace

void bind_rawlog(py::module_& m) {
  bind_frame(m);
  bind_log(m);
  m.def("read_sensors", &sensors, py::arg("log"), "GPS and IMU of a whole log: oneac.Sensors.");
  m.def("describe_log", &describe, py::arg("log"), "What `oneac info` says of a log.");
}

}  // namespace oneac::python
