#include "oneac/study/readings.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>

namespace oneac {
namespace {

TEST(Readings, CoverEveryNoiseShapeWithEveryUseOfTheData) {
  std::set<std::pair<NoiseShape, DataUse>> seen;
  std::set<std::string_view> meanings;
  for (const Reading& reading : readings()) {
    seen.insert({reading.noise_shape, reading.data_use});
    meanings.insert(reading.meaning);
  }
  EXPECT_EQ(seen.size(), 8U);
  EXPECT_EQ(meanings.size(), 8U);
}

TEST(Readings, TheFirstIsTheDefaultOfTheStudy) {
  const StudyOptions options;
  EXPECT_EQ(readings().front().noise_shape, options.noise_shape);
  EXPECT_EQ(readings().front().data_use, options.data_use);
}

TEST(Readings, RunTheWantedExperimentsThatClaimsRestOn) {
  StudyOptions options;
  options.trials = 2;
  options.figures = {"b", "s9"};  // the second is no claim of the paper's text
  double last = 0.0;
  const auto results = run_readings(options, [&last](double share, std::size_t) {
    EXPECT_GT(share, last);
    last = share;
    return true;
  });
  EXPECT_DOUBLE_EQ(last, 1.0);
  ASSERT_EQ(results.size(), readings().size());
  for (std::size_t i = 0; i < results.size(); ++i) {
    EXPECT_EQ(results[i].options.noise_shape, readings()[i].noise_shape);
    EXPECT_EQ(results[i].options.data_use, readings()[i].data_use);
    ASSERT_EQ(results[i].experiments.size(), 1U);
    EXPECT_EQ(results[i].experiments[0].experiment->name, "forward_ground");
  }
  options.figures = {"s9"};
  EXPECT_TRUE(run_readings(options).empty());
}

}  // namespace
}  // namespace oneac
