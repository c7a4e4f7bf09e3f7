#include "oneac/frontend/map_formats.h"

#include "oneac/mrpt_compat/simple_map.h"
#include "oneac/test_support/temporary_folder.h"

#include <gtest/gtest.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/serialization/CArchive.h>

#include <fstream>
#include <sstream>

namespace oneac {
namespace {

std::vector<Keyframe> two_keyframes() {
  std::vector<Keyframe> keyframes(2);
  keyframes[1].id = 1;
  keyframes[1].time_s = 12.5;
  keyframes[1].T_first_cam.translation() << 0.25, 0.0, 2.0;
  keyframes[1].T_first_cam.linear() = yaw_rotation(std::cos(-0.2), std::sin(-0.2));
  keyframes[1].information = 100.0 * Eigen::Matrix<double, 6, 6>::Identity();
  keyframes[1].information(0, 5) = keyframes[1].information(5, 0) = 7.0;
  keyframes[1].points.push_back({{1.0F, 2.0F, 3.5F}, {0.0F, -1.0F, 0.0F}, 200, 4});
  return keyframes;
}

TEST(MapFormats, G2oHoldsVerticesAndTheEdgeBetweenThem) {
  std::istringstream text(format_g2o(two_keyframes()));
  std::string line, word;
  std::getline(text, line);
  EXPECT_EQ(line, "VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1");
  std::getline(text, line);
  std::getline(text, line);
  std::istringstream edge(line);
  int from = -1, to = -1;
  double x = 0.0;
  edge >> word >> from >> to >> x;
  EXPECT_EQ(word, "EDGE_SE3:QUAT");
  EXPECT_EQ(from, 0);
  EXPECT_EQ(to, 1);
  EXPECT_EQ(x, 0.25);
  std::vector<double> rest;
  for (double value = 0.0; edge >> value;) rest.push_back(value);
  ASSERT_EQ(rest.size(), 6U + 21U);
  EXPECT_EQ(rest[6], 100.0);
  EXPECT_EQ(rest[11], 7.0);  // the end of the first row
  EXPECT_EQ(rest[26], 100.0);
}

TEST(MapFormats, PlyCountsItsPoints) {
  std::ostringstream out;
  write_ply(two_keyframes(), out);
  const std::string text = out.str();
  EXPECT_NE(text.find("element vertex 1\n"), std::string::npos);
  EXPECT_NE(text.find("end_header\n1 2 3.5 0 -1 0 200 200 200\n"), std::string::npos);
}

TEST(MapFormats, SimpleMapWrittenPieceByPieceIsTheOneThatMrptWrites) {
  std::vector<Keyframe> keyframes = two_keyframes();
  for (int i = 0; i < 298; ++i) keyframes.push_back(keyframes[1]);  // more than a byte counts
  const std::string ours =
      format_simple_map(keyframes, Eigen::Isometry3d::Identity(), PinholeCamera{});
  mrpt::io::CMemoryStream in, out;
  in.assignMemoryNotOwn(ours.data(), ours.size());
  mrpt::maps::CSimpleMap map;
  mrpt::serialization::archiveFrom(in) >> map;
  ASSERT_EQ(map.size(), 300U);
  mrpt::serialization::archiveFrom(out) << map;
  const std::string mrpts(static_cast<const char*>(out.getRawBufferData()),
                          static_cast<std::size_t>(out.getTotalBytesCount()));
  EXPECT_TRUE(ours == mrpts);
}

TEST(MapFormats, SimpleMapIsReadByMrpt) {
  const TemporaryFolder folder;
  const std::string path = (folder.path() / "map.simplemap").string();
  PinholeCamera camera;
  camera.fx = 721.5;
  Eigen::Isometry3d mount = Eigen::Isometry3d::Identity();
  mount.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  std::ofstream(path, std::ios::binary) << format_simple_map(two_keyframes(), mount, camera);
  mrpt::maps::CSimpleMap map;
  ASSERT_TRUE(map.loadFromFile(path));
  ASSERT_EQ(map.size(), 2U);
  const auto pair = compat::keyframe_of(map, 1);
  const auto pose = pair.pose->getMeanVal();
  EXPECT_NEAR(pose.x(), 2.0, 1e-9);  // forward
  EXPECT_NEAR(pose.y(), -0.25, 1e-9);
  EXPECT_NEAR(pose.yaw(), -0.2, 1e-9);  // a turn to the right
  const auto image = pair.sf->getObservationByClass<mrpt::obs::CObservationImage>();
  ASSERT_TRUE(image);
  EXPECT_DOUBLE_EQ(image->cameraParams.fx(), 721.5);
}

}  // namespace
}  // namespace oneac
