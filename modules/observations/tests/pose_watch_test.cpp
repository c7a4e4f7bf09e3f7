#include "oneac/observations/pose_watch.h"

#include "log_maker.h"

#include <gtest/gtest.h>

#include <initializer_list>

namespace oneac {
namespace {

/// Positions to the left [m], image by image; what the watch says of the last.
std::string complaint(std::initializer_list<double> places) {
  PoseWatch watch;
  std::string said;
  for (const double y : places) {
    CameraView view;
    view.label = "CAM";
    view.T_vehicle_sensor.translation().y() = y;
    EXPECT_EQ(said, "");
    said = test::input_error([&] { watch.check(view, "log: record 7"); });
  }
  return said;
}

TEST(PoseWatch, RefusesTwoCamerasUnderOneLabel) {
  const std::string said = complaint({0.0, 0.5, 0.0, 0.5});
  EXPECT_NE(said.find("record 7"), std::string::npos) << said;
  EXPECT_NE(said.find("two cameras have one label"), std::string::npos) << said;
  EXPECT_NE(said.find("rawlog-edit"), std::string::npos) << said;
}

TEST(PoseWatch, LetsACameraMove) {
  EXPECT_EQ(complaint({0.0, 0.0, 0.0, 0.0, 0.0}), "");
  EXPECT_EQ(complaint({0.0, 0.5, 0.5, 0.5, 0.0, 0.0}), "");
  EXPECT_EQ(complaint({0.0, 0.5, 1.0, 1.5, 2.0}), "");
  EXPECT_EQ(complaint({0.0, 0.005, 0.0, 0.005, 0.0}), "") << "noise of a calibration on line";
}

TEST(PoseWatch, NoticesCamerasThatOnlyLookElsewhere) {
  PoseWatch watch;
  std::string said;
  for (int i = 0; i < 4; ++i) {
    CameraView view;
    const Eigen::AngleAxisd turn(i % 2 == 0 ? 0.0 : 0.1, Eigen::Vector3d::UnitZ());
    view.T_vehicle_sensor.linear() = turn.toRotationMatrix();
    said = test::input_error([&] { watch.check(view, ""); });
  }
  EXPECT_NE(said, "");
}

}  // namespace
}  // namespace oneac
