#include "oneac/rawlog/track_files.h"

#include "import/gps_text.h"

#include "oneac/test_support/temporary_folder.h"

#include <expat.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

namespace oneac {
namespace {

const GeodeticPosition kMalaga{36.7154, -4.4771, 38.8};

bool is_well_formed(const std::string& text) {
  XML_Parser parser = XML_ParserCreate(nullptr);
  const bool good = XML_Parse(parser, text.data(), static_cast<int>(text.size()), 1) != 0;
  XML_ParserFree(parser);
  return good;
}

Track track() {
  Track way{"drive <1> & \x01 \xc3\xa4", "SE(2), residual 0.4 m", {}, true};
  for (int i = 0; i < 20; ++i) {
    way.points.push_back(
        {1260007200.25 + 0.1 * i, geodetic_from_enu({3.0 * i, -2.0 * i, 0.5}, kMalaga)});
  }
  return way;
}

TEST(TrackFiles, GpxReadsBackAsItWas) {
  const TemporaryFolder folder;
  const Track written = track();
  const std::string text = format_gpx(written);
  ASSERT_TRUE(is_well_formed(text)) << text;
  std::ofstream(folder.path() / "a.gpx") << text;
  ImportReport report;
  const std::vector<GpsRecord> read = read_gpx(folder.path() / "a.gpx", report);
  ASSERT_EQ(read.size(), written.points.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_NEAR(read[i].time_s, written.points[i].time_s, 6e-4);
    EXPECT_NEAR(read[i].position.latitude_deg, written.points[i].place.latitude_deg, 1e-8);
    EXPECT_NEAR(read[i].position.longitude_deg, written.points[i].place.longitude_deg, 1e-8);
    EXPECT_NEAR(read[i].position.altitude_m, written.points[i].place.altitude_m, 1e-3);
  }
  EXPECT_NE(text.find("2009-12-05T10:00:00.250Z"), std::string::npos) << text;
}

TEST(TrackFiles, KmlIsALineWithLongitudesFirst) {
  const std::string text = format_kml(track());
  ASSERT_TRUE(is_well_formed(text)) << text;
  EXPECT_NE(text.find("          -4.4771"), std::string::npos) << text;
  EXPECT_EQ(text.find('\x01'), std::string::npos);
}

TEST(TrackFiles, TellNoHeightsThatNobodyKnows) {
  Track way = track();
  EXPECT_NE(format_gpx(way).find("<ele>"), std::string::npos);
  way.has_heights = false;
  EXPECT_EQ(format_gpx(way).find("<ele>"), std::string::npos);
  EXPECT_TRUE(is_well_formed(format_gpx(way)));
  const std::string kml = format_kml(way);
  const std::size_t first = kml.find("-4.4771");
  EXPECT_EQ(kml.substr(first, kml.find('\n', first) - first), "-4.47710000,36.71540000");
}

TEST(TrackFiles, RefuseWhatIsNoPlaceOrTime) {
  Track way = track();
  way.points[3].place.latitude_deg = 91.0;
  EXPECT_THROW(static_cast<void>(format_gpx(way)), std::invalid_argument);
  way = track();
  way.points[3].time_s = std::nan("");
  EXPECT_THROW(static_cast<void>(format_kml(way)), std::invalid_argument);
  way = track();
  way.points[3].place.longitude_deg = 180.0;
  EXPECT_NE(format_gpx(way).find("lon=\"-180.00000000\""), std::string::npos);
}

}  // namespace
}  // namespace oneac
