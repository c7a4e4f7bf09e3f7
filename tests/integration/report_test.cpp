#include "drive_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <regex>
#include <string>
#include <vector>

namespace oneac {
namespace {

namespace fs = std::filesystem;

class Report : public DriveFixture {
 protected:
  [[nodiscard]] std::string report(const std::string& name,
                                   const std::vector<std::string>& extra = {}) const {
    const fs::path folder = scratch() / name;
    std::vector<std::string> arguments{"run", log(), "-o", folder.string()};
    arguments.insert(arguments.end(), extra.begin(), extra.end());
    const ProgramResult result = oneac_program(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return read_file(folder / "report.html");
  }
  /// Without the letters of its pictures, which may spell anything.
  [[nodiscard]] static std::string words_of(std::string html) {
    const std::string picture = "base64,";
    for (auto at = html.find(picture); at != std::string::npos; at = html.find(picture, at)) {
      at += picture.size();
      html.erase(at, html.find('"', at) - at);
    }
    return html;
  }
  /// Everything before the section that depends on the clock.
  [[nodiscard]] static std::string without_timing(const std::string& html) {
    const auto timing = html.find("<h2>Timing</h2>");
    EXPECT_NE(timing, std::string::npos);
    return html.substr(0, timing);
  }
};

TEST_F(Report, NeedsNothingButItself) {
  const std::string html = report("a");
  EXPECT_NE(html.find("default-src 'none'"), std::string::npos);
  EXPECT_EQ(html.find("<script"), std::string::npos);
  EXPECT_EQ(html.find("<link"), std::string::npos);
  EXPECT_EQ(html.find("url("), std::string::npos);
  const std::regex source(R"((?:src|href)="([^"]{0,30}))");
  std::size_t pictures = 0;
  for (std::sregex_iterator i(html.begin(), html.end(), source), end; i != end; ++i) {
    EXPECT_EQ((*i)[1].str().rfind("data:image/jpeg;base64,", 0), 0U) << (*i)[1];
    ++pictures;
  }
  EXPECT_GT(pictures, 0U);
}

TEST_F(Report, DrawsTheDriveItsReferenceAndAFrame) {
  const std::string html = report("a");
  for (const char* text :
       {">Seen from above, first heading up<", ">Speed<", ">Yaw rate (left positive)<", ">Scale<",
        ">Tilt of the camera, as believed<", ">Affine correspondences<",
        ">Rotation error of a pair<", ">CPU time of the stages<", ">reference<", ">GPS<",
        "<h2>A frame</h2>", "class=\"inlier\"", "<h2>Summary</h2>", "t rel"}) {
    EXPECT_NE(html.find(text), std::string::npos) << text;
  }
  EXPECT_EQ(html.find("no values"), std::string::npos);
  EXPECT_EQ(words_of(html).find("nan"), std::string::npos);
}

TEST_F(Report, IsTheSameAtAnyThreadCountButForTheTiming) {
  EXPECT_EQ(without_timing(report("one", {"--threads", "1"})),
            without_timing(report("four", {"--threads", "4"})));
}

TEST_F(Report, StandsWithoutReferenceOrWithASingleFrame) {
  const std::string html = report("a", {"--count", "1"});
  EXPECT_EQ(words_of(html).find("nan"), std::string::npos);
  EXPECT_EQ(html.find("<h2>Worst frames</h2>"), std::string::npos);
}

TEST_F(Report, WindowWithoutADisplayIsWrongUsage) {
  ::unsetenv("DISPLAY");
  ::unsetenv("WAYLAND_DISPLAY");
  const ProgramResult result = oneac_program({"run", log(), "-o", out(), "--gui"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("--gui"), std::string::npos) << result.err;
  EXPECT_FALSE(fs::exists(fs::path(out()) / "summary.json"));
}

class FeaturesVerb : public DriveFixture {};

TEST_F(FeaturesVerb, WritesStatisticsOfEveryPair) {
  const ProgramResult result =
      oneac_program({"features", log(), "-o", out(), "--features", "klt", "--picture-every", "3"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const fs::path folder(out());
  const std::string pairs = read_file(folder / "pairs.csv");
  EXPECT_EQ(pairs.substr(0, pairs.find('\n')),
            "index1,index2,acs,followed,standing,motion_px,affine_residual,ms_decode,ms_features");
  EXPECT_EQ(std::count(pairs.begin(), pairs.end(), '\n'), kFrames);  // head and kFrames − 1 pairs
  for (const char* name : {"regions.csv", "track_lengths.csv", "summary.md", "regions.png",
                           "tracks_000001.png", "tracks_000004.png", "tracks_000007.png"}) {
    EXPECT_GT(fs::file_size(folder / name), 20U) << name;
  }
  EXPECT_FALSE(fs::exists(folder / "tracks_000002.png"));
}

TEST_F(FeaturesVerb, CountsTracksThatLiveThroughTheDrive) {
  ASSERT_EQ(oneac_program({"features", log(), "-o", out(), "--features", "klt"}).exit_code, 0);
  const std::string lengths = read_file(fs::path(out()) / "track_lengths.csv");
  // Some live from the first image to the last, none longer.
  EXPECT_NE(lengths.find("\n" + std::to_string(kFrames) + ","), std::string::npos) << lengths;
  EXPECT_EQ(lengths.find("\n" + std::to_string(kFrames + 1) + ","), std::string::npos) << lengths;
}

TEST_F(FeaturesVerb, ExplainsAnUnknownExtractor) {
  const ProgramResult result = oneac_program({"features", log(), "-o", out(), "--features", "orb"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("klt"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace oneac
