#include "fault_fixture.h"

#include "oneac/rawlog/log_summary.h"
#include "oneac/rawlog/rawlog_source.h"
#include "oneac/test_support/mutation.h"

#include <mrpt/obs/CSensoryFrame.h>

#include <opencv2/core.hpp>

#include <algorithm>
#include <cstdlib>

namespace oneac {
namespace {

namespace fs = std::filesystem;
using test::Packing;

/// Everything that a log may hold: images of every kind, pairs, GPS, frames.
test::Objects one_of_each() {
  const cv::Mat colour(test::kHeight, test::kWidth, CV_8UC3, cv::Scalar(20, 90, 160));
  auto frame = mrpt::obs::CSensoryFrame::Create();
  *frame += mrpt::obs::CObservation::Ptr(test::rmc(0.2, 10, 90));
  *frame += mrpt::obs::CObservation::Ptr(test::stored_image("COLOUR", 0.2, colour));
  mrpt::img::CImage::DISABLE_JPEG_COMPRESSION(false);
  test::Objects objects;
  for (int i = 0; i < 4; ++i) {
    objects.push_back(test::external_image("CAM", i, "frame_" + std::to_string(i % 3) + ".png"));
    objects.push_back(test::stored_image("COLOUR", i, colour));
    objects.push_back(test::stored_image("GREY", i, test::ramp(i)));
    objects.push_back(test::external_pair("PAIR", i, "pair"));
    objects.push_back(test::gga(i, 36.7, -4.4, 70));
    objects.push_back(frame);
  }
  return objects;
}

class MutatedLogs : public FaultFixture {
 protected:
  void SetUp() override { static_cast<void>(textured_frames(3)); }

  void read_it_all(const std::string& camera) const {
    SummaryOptions summary_options;
    summary_options.log = log();
    static_cast<void>(to_text(summarise_log(summary_options)));
    RawlogSource source({log(), {}, camera, "", "auto", {}, 0, 0, 1, false, 0.0, {}});
    while (const auto ticket = source.next()) static_cast<void>(source.load(*ticket));
    source.finish();
  }
};

// A crash, a hang or an exception of another kind fails the test.
TEST_F(MutatedLogs, AreReadOrRefusedByTheLibrary) {
  constexpr std::uint64_t kCopies = 1500;
  const std::string plain = test::packed(one_of_each());
  const char* const cameras[] = {"CAM", "COLOUR", "GREY", "PAIR"};
  std::size_t refused = 0;
  for (std::uint64_t seed = 0; seed < kCopies; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    test::write_bytes(log(), mutated(plain, seed));
    try {
      read_it_all(cameras[seed % 4]);
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, kCopies / 20) << "the injuries are too mild to test anything";
}

// Exit code 0 or 2, and every line that is lost is told.
TEST_F(MutatedLogs, EndTheProgramWithZeroOrTwo) {
  for (const Packing packing : {Packing::plain, Packing::gzip, Packing::zstd}) {
    const std::string whole = test::packed(one_of_each(), packing);
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
      SCOPED_TRACE("packing " + std::to_string(static_cast<int>(packing)) + " seed " +
                   std::to_string(seed));
      test::write_bytes(log(), mutated(whole, seed));
      const ProgramResult result = run({"--camera", seed % 2 == 0 ? "CAM" : "COLOUR"});
      EXPECT_TRUE(result.exit_code == 0 || result.exit_code == 2) << result.exit_code << result.err;
      expect_exit(result, result.exit_code, {});
      EXPECT_TRUE(result.exit_code == 0 || !result.err.empty());
    }
  }
}

TEST_F(MutatedLogs, ACutLogIsUsedUpToTheCutAndNeverASuccess) {
  const std::string whole = test::packed(one_of_each());
  for (std::size_t cut = 100; cut + 1 < whole.size(); cut += whole.size() / 25) {
    SCOPED_TRACE("cut at " + std::to_string(cut));
    test::write_bytes(log(), whole.substr(0, cut));
    std::string damage;
    try {
      RawlogSource source({log(), {}, "GREY", "", "auto", {}, 0, 0, 1, false, 0.0, {}});
      while (source.next()) continue;
      damage = source.report().damage;
    } catch (const InputError& error) {
      damage = error.what();
    }
    EXPECT_NE(damage, "");
    EXPECT_EQ(damage.find('\n'), std::string::npos) << damage;
  }
}

/// Copies of the real log, as many as ONEAC_MUTATIONS says; the program says which seed failed.
TEST(MutatedRealLog, IsReadOrRefused) {
  const char* folder = std::getenv("ONEAC_REAL_DATA");
  const fs::path data = folder != nullptr ? fs::path(folder) : fs::path(ONEAC_DATA);
  const char* count = std::getenv("ONEAC_MUTATIONS");
  const ProgramResult result =
      run_program({ONEAC_MUTATE_LOG,
                   (data / "malaga-07" / "malaga-urban-dataset-extract-07_CAM_GPS.rawlog").string(),
                   count != nullptr ? count : "200"});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_NE(result.out.find("MB of memory at most"), std::string::npos) << result.out;
}

}  // namespace
}  // namespace oneac
