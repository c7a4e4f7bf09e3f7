#include "run_gui.h"

#include "run_gui_text.h"
#include "terminal/interrupt.h"

#include "oneac/base/error.h"

#include <mrpt/gui/CDisplayWindow3D.h>
#include <mrpt/img/CImage.h>
#include <mrpt/opengl/CFrustum.h>
#include <mrpt/opengl/CGridPlaneXY.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/opengl/CPointCloud.h>
#include <mrpt/opengl/CPointCloudColoured.h>
#include <mrpt/opengl/CSetOfLines.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/opengl/opengl_fonts.h>
#include <mrpt/poses/CPose3D.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <thread>

namespace oneac::app {
namespace {

using Clock = std::chrono::steady_clock;
using mrpt::img::TColor;

constexpr int kWidth = 1280, kHeight = 800;               // [px]
constexpr std::chrono::milliseconds kRedraw{40};          // more often nobody sees
constexpr std::chrono::milliseconds kLook{50};            // for the window being closed
constexpr float kZoom = 45.0F, kElevation = 35.0F;        // [m] behind the car, [deg] above it
constexpr float kGrid = 10.0F, kGridExtent = 1000.0F;     // [m]
constexpr float kFrustumNear = 0.1F, kFrustumFar = 2.0F;  // [m]
constexpr double kHalfSide = 8.0;                         // [px] of the square that A is shown on
constexpr float kLineWidth = 3.0F, kPointSize = 2.0F, kKeyframeSize = 6.0F;  // [px]
const TColor kWay(93, 180, 238), kKeyframe(255, 146, 72), kInk(79, 195, 255), kFloor(70, 78, 88);
const TColor kPoint(190, 190, 190), kText(240, 240, 240);  // points are as grey as in the image
constexpr float kFontSize = 11.0F;                         // [px]
constexpr double kLine = 22.0, kMargin = 16.0;             // [px]
constexpr double kLegendWidth = 330.0;                     // [px] of its longest line
// Of text messages; the lines of the state have the numbers from zero on.
constexpr std::size_t kStateLines = 3, kFirstOfLegend = 10;

struct LegendLine {
  const char* text;
  const TColor& colour;
};
const LegendLine kLegend[] = {{"way and camera", kWay},
                              {"keyframes", kKeyframe},
                              {"landmarks", kPoint},
                              {"in the image: correspondences", kInk},
                              {"floor: 10 m a square", kPoint}};

/// A line of text, kept by its number. @param x, y  [px] from the left and the bottom; negative:
/// from the right and the top
void write(mrpt::opengl::COpenGLViewport& view, double x, double y, const std::string& text,
           std::size_t number, const TColor& colour) {
  mrpt::opengl::TFontParams font;
  font.vfont_name = "sans";
  font.vfont_scale = kFontSize;
  font.color = mrpt::img::TColorf(colour);
  font.draw_shadow = true;
  view.addTextMessage(x, y, text, number, font);
}

void write_legend(mrpt::opengl::COpenGLViewport& view) {
  double y = -kMargin - kLine;
  std::size_t number = kFirstOfLegend;
  for (const LegendLine& line : kLegend) {
    write(view, -kLegendWidth, y, line.text, number++, line.colour);
    y -= kLine;
  }
}

/// Optical axes seen by axes X forward, Y left, Z up.
Eigen::Matrix3d optical_from_forward() {
  return CameraFrame::forward_looking_mount().linear().transpose();
}

mrpt::poses::CPose3D pose_of(const Eigen::Isometry3d& T) {
  return mrpt::poses::CPose3D(mrpt::math::CMatrixDouble44(T.matrix()));
}

float single(double value) {
  return static_cast<float>(value);
}

int pixel(double coordinate) {
  return static_cast<int>(std::lround(coordinate));
}

void draw(mrpt::img::CImage& canvas, const AffineCorrespondence& ac) {
  if (!ac.is_finite()) return;
  const auto line = [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    canvas.line(pixel(a.x()), pixel(a.y()), pixel(b.x()), pixel(b.y()), kInk);
  };
  line(ac.x1, ac.x2);
  std::array<Eigen::Vector2d, 4> corners = {
      Eigen::Vector2d(-kHalfSide, -kHalfSide), Eigen::Vector2d(kHalfSide, -kHalfSide),
      Eigen::Vector2d(kHalfSide, kHalfSide), Eigen::Vector2d(-kHalfSide, kHalfSide)};
  for (Eigen::Vector2d& corner : corners) corner = ac.x2 + ac.A * corner;
  for (std::size_t i = 0; i < corners.size(); ++i) line(corners[i], corners[(i + 1) % 4]);
}

mrpt::img::CImage picture_of(const GreyImage& image, const TrackedPair& pair) {
  mrpt::img::CImage grey(static_cast<unsigned>(image.width()),
                         static_cast<unsigned>(image.height()), mrpt::img::CH_GRAY);
  for (int v = 0; v < image.height(); ++v) {
    std::copy_n(image.row(v), image.width(), grey.ptrLine<std::uint8_t>(static_cast<unsigned>(v)));
  }
  mrpt::img::CImage colour = grey.colorImage();
  for (const Correspondence& ac : pair.correspondences) draw(colour, ac);
  return colour;
}

void require_display() {
  if (std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr) return;
  throw InputError("--gui", "there is no display",
                   "run it on a desktop, under xvfb-run, or leave --gui out");
}

}  // namespace

class RunGui::Impl {
 public:
  Impl() : window_("oneac run", kWidth, kHeight) {
    const auto floor = mrpt::opengl::CGridPlaneXY::Create(-kGridExtent, kGridExtent, -kGridExtent,
                                                          kGridExtent, 0.0F, kGrid);
    floor->setColor_u8(kFloor);
    way_->setColor_u8(kWay);
    way_->setLineWidth(kLineWidth);
    frustum_->setColor_u8(kWay);
    frustum_->setNearFarPlanes(kFrustumNear, kFrustumFar);
    keyframes_->setColor_u8(kKeyframe);
    keyframes_->setPointSize(kKeyframeSize);
    points_->setPointSize(kPointSize);
    auto& scene = window_.get3DSceneAndLock();
    scene->getViewport()->setCustomBackgroundColor({0.08F, 0.09F, 0.11F});
    scene->insert(floor);
    drive_->insert(way_);
    drive_->insert(keyframes_);
    drive_->insert(points_);
    drive_->insert(frustum_);
    scene->insert(drive_);
    write_legend(*scene->getViewport());
    window_.unlockAccess3DScene();
    window_.setCameraAzimuthDeg(180.0F);  // from behind: the first heading is X
    window_.setCameraElevationDeg(kElevation);
    window_.setCameraZoom(kZoom);
  }

  [[nodiscard]] bool is_open() { return window_.isOpen(); }

  void show(const RunMoment& moment) {
    const Clock::time_point now = Clock::now();
    if (!is_open() || now - last_ < kRedraw) return;
    last_ = now;
    auto& scene = window_.get3DSceneAndLock();
    update(moment.record);
    tell(*scene->getViewport(), moment.record);
    if (!scene->getViewport("image")) {
      const double width = 0.45;
      const double height = width * kWidth / kHeight * moment.image.height() / moment.image.width();
      scene->createViewport("image")->setViewportPosition(0.01, 0.99 - height, width, height);
    }
    scene->getViewport("image")->setImageView(picture_of(moment.image, moment.pair));
    window_.unlockAccess3DScene();
    look_at(moment.record);
  }

  void finish(const DriveRecord& record) {
    if (!is_open()) return;
    auto& scene = window_.get3DSceneAndLock();
    update(record);
    tell(*scene->getViewport(), record);
    window_.unlockAccess3DScene();
    look_at(record);
  }

 private:
  /// @pre the scene is locked
  static void tell(mrpt::opengl::COpenGLViewport& view, const DriveRecord& record) {
    std::vector<std::string> lines = gui_lines(record.frames);
    lines.resize(kStateLines);
    double y = kMargin + kLine * (kStateLines - 1);
    for (std::size_t i = 0; i < kStateLines; ++i, y -= kLine) {
      write(view, kMargin, y, lines[i], i, kText);
    }
  }

  /// @pre the scene is locked
  void update(const DriveRecord& record) {
    if (record.frames.empty()) return;
    drive_->setPose(pose_of(record.mount()));
    way_->clear();
    Eigen::Vector3d before = Eigen::Vector3d::Zero();
    for (const FrameResult& frame : record.frames) {
      const Eigen::Vector3d now = frame.T_first_cam.translation();
      way_->appendLine(before.x(), before.y(), before.z(), now.x(), now.y(), now.z());
      before = now;
    }
    Eigen::Isometry3d T = record.frames.back().T_first_cam;
    T.linear() = T.linear() * optical_from_forward();
    frustum_->setPose(pose_of(T));
    const PinholeCamera& camera = record.camera;
    const double half_width = std::atan(0.5 * camera.width / camera.fx);
    const double half_height = std::atan(0.5 * camera.height / camera.fy);
    frustum_->setHorzFOV(single(2.0 * half_width * 180.0 / M_PI));
    frustum_->setVertFOV(single(2.0 * half_height * 180.0 / M_PI));
    for (; shown_ < record.keyframes.size(); ++shown_) {
      add(record.keyframes[shown_], record.keyframes.points(shown_));
    }
  }

  void add(const Keyframe& keyframe, const std::vector<MapPoint>& points) {
    const Eigen::Vector3d at = keyframe.T_first_cam.translation();
    keyframes_->insertPoint(single(at.x()), single(at.y()), single(at.z()));
    for (const MapPoint& point : points) {
      const Eigen::Vector3f& p = point.position;
      const float grey = 0.3F + 0.7F * static_cast<float>(point.grey) / 255.0F;  // on a dark ground
      points_->push_back(p.x(), p.y(), p.z(), grey, grey, grey);
    }
  }

  void look_at(const DriveRecord& record) {
    if (record.frames.empty()) return;
    const Eigen::Vector3d at = record.mount() * record.frames.back().T_first_cam.translation();
    window_.setCameraPointingToPoint(single(at.x()), single(at.y()), single(at.z()));
    window_.forceRepaint();
  }

  mrpt::gui::CDisplayWindow3D window_;
  /// In the first camera's frame, placed on the ground by the mount.
  mrpt::opengl::CSetOfObjects::Ptr drive_ = mrpt::opengl::CSetOfObjects::Create();
  mrpt::opengl::CSetOfLines::Ptr way_ = mrpt::opengl::CSetOfLines::Create();
  mrpt::opengl::CPointCloud::Ptr keyframes_ = mrpt::opengl::CPointCloud::Create();
  mrpt::opengl::CPointCloudColoured::Ptr points_ = mrpt::opengl::CPointCloudColoured::Create();
  mrpt::opengl::CFrustum::Ptr frustum_ = mrpt::opengl::CFrustum::Create();
  std::size_t shown_ = 0;  ///< keyframes in the scene
  Clock::time_point last_;
};

RunGui::RunGui() : impl_((require_display(), std::make_unique<Impl>())) {}

RunGui::~RunGui() = default;

void RunGui::show(const RunMoment& moment) {
  impl_->show(moment);
}

void RunGui::wait(const DriveRecord& record) {
  impl_->finish(record);
  while (impl_->is_open() && !interrupted()) std::this_thread::sleep_for(kLook);
}

}  // namespace oneac::app
