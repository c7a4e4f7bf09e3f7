#include "map/settling.h"

#include <gtest/gtest.h>

namespace oneac {
namespace {

RelativePose ahead(double metres) {
  return {Eigen::Matrix3d::Identity(), Eigen::Vector3d(0.0, 0.0, -metres)};
}

/// Three keyframes a length apart, frames half-way between; each later keyframe halves the share
/// of the steps before it.
class SettlingOnALine : public testing::Test {
 protected:
  SettlingOnALine() : map_(WindowOptions{}, 700.0) {
    map_.start(0, ahead(0.0));
    settling_.add_keyframe(0, {});
    for (std::size_t id = 1; id <= 2; ++id) {
      settling_.add_frame(2 * id - 1, id - 1, ahead(0.5));
      map_.add_keyframe(2 * id, ahead(static_cast<double>(id)));
      settling_.drift(0.5);
      settling_.add_keyframe(id, {});
    }
  }

  void correct(double factor) {
    map_.rescale(factor);
    settling_.rescale(factor);
  }

  Settled settled() {
    Settled settled;
    settling_.settle_all(map_, settled);
    return settled;
  }

  LocalMap map_;
  Settling settling_;
};

TEST_F(SettlingOnALine, KeepsTheMapWithoutACorrection) {
  const Settled all = settled();
  ASSERT_EQ(all.keyframes.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(all.keyframes[i].T_first_cam.translation().z(), static_cast<double>(i), 1e-12);
  }
}

TEST_F(SettlingOnALine, GivesAStepItsShareOfALaterCorrection) {
  correct(1.44);
  const Settled all = settled();
  ASSERT_EQ(all.keyframes.size(), 3U);
  EXPECT_NEAR(all.keyframes[0].T_first_cam.translation().z(), 0.0, 1e-12);
  EXPECT_NEAR(all.keyframes[1].T_first_cam.translation().z(), 1.2, 1e-12) << "half of it, √1.44";
  EXPECT_NEAR(all.keyframes[2].T_first_cam.translation().z(), 1.2 + 1.44, 1e-12) << "all of it";
}

TEST_F(SettlingOnALine, StretchesTheFramesBetweenWithTheirStep) {
  correct(1.44);
  const Settled all = settled();
  ASSERT_EQ(all.frames.size(), 2U);
  EXPECT_NEAR(all.frames[0].T_first_cam.translation().z(), 0.6, 1e-12);
  EXPECT_NEAR(all.frames[1].T_first_cam.translation().z(), 1.2 + 0.72, 1e-12);
}

TEST(Settling, BendsTheFramesBetweenWithTheirStep) {
  LocalMap map{WindowOptions{}, 700.0};
  Settling settling;
  map.start(0, ahead(0.0));
  settling.add_keyframe(0, {});
  for (int i = 1; i <= 9; ++i) settling.add_frame(static_cast<std::size_t>(i), 0, ahead(0.1 * i));
  RelativePose moved = ahead(1.0);
  moved.t.x() = 0.1;  // an adjustment moved the keyframe to the left
  map.add_keyframe(10, moved);
  Settling::Note note;
  note.T_from_before = ahead(1.0);
  settling.add_keyframe(1, note);
  Settled all;
  settling.settle_all(map, all);
  ASSERT_EQ(all.frames.size(), 9U);
  double expected = 0.0;
  for (const SettledFrame& frame : all.frames) {
    EXPECT_NEAR(frame.T_first_cam.translation().x(), expected -= 0.01, 1e-3);
  }
}

TEST_F(SettlingOnALine, TellsHowFarItLiesFromTheMap) {
  correct(1.44);
  const Settled all = settled();
  EXPECT_NEAR(settling_.offset().z() + 2.0 * 1.44, all.keyframes[2].T_first_cam.translation().z(),
              1e-12);
}

TEST(Settling, BendsTheFramesOfAStepThatKeptItsLengthExactly) {
  LocalMap map(WindowOptions{}, 700.0);
  Settling settling;
  map.start(0, ahead(0.0));
  settling.add_keyframe(0, {});
  settling.add_frame(1, 0, ahead(1.0));
  const RelativePose turned{rotation_from_vector({0.0, 0.05, 0.0}), ahead(1.0).t};
  map.add_keyframe(1, turned);
  settling.add_keyframe(1, {1, 0.0, 0, false, 0.0, ahead(1.0)});
  Settled all;
  settling.settle_all(map, all);
  ASSERT_EQ(all.frames.size(), 1U);
  const Eigen::Vector3d there = all.keyframes[1].T_first_cam.translation();
  EXPECT_LT((all.frames[0].T_first_cam.translation() - there).norm(), 1e-9);
}

}  // namespace
}  // namespace oneac
