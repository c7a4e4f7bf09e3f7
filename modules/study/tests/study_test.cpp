#include "oneac/study/study.h"

#include "oneac/study/readings.h"
#include "oneac/study/report.h"
#include "oneac/test_support/temporary_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>

namespace oneac {
namespace {

StudyOptions small(std::vector<std::string> figures, std::size_t trials) {
  StudyOptions options;
  options.figures = std::move(figures);
  options.trials = trials;
  return options;
}

std::string content_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(Study, WritesTheSameBytesAtOneAndThreeThreads) {
  const TemporaryFolder one, three;
  StudyOptions options = small({}, 20);
  const auto first = write_study(run_study(options), run_readings(options), one.path());
  options.threads = 3;
  const auto second = write_study(run_study(options), run_readings(options), three.path());
  ASSERT_EQ(first.size(), 2 * figures().size() + 1);
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].filename(), second[i].filename());
    EXPECT_FALSE(content_of(first[i]).empty());
    EXPECT_EQ(content_of(first[i]), content_of(second[i])) << first[i].filename();
  }
}

TEST(Study, AFigureAloneHasTheNumbersThatItHasAmongAll) {
  const auto alone = run_study(small({"h"}, 30));
  const auto all = run_study(small({}, 30));
  ASSERT_EQ(alone.experiments.size(), 1U);
  ASSERT_EQ(all.experiments.size(), experiments().size());
  const Figure h = wanted_figures(small({"h"}, 30)).front();
  EXPECT_EQ(csv_of(*alone.find("sideways_wall"), h, 30), csv_of(*all.find("sideways_wall"), h, 30));
}

TEST(Study, TheSeedDecides) {
  StudyOptions options = small({"a"}, 30);
  const Figure& a = figures().front();
  const std::string first = csv_of(run_study(options).experiments[0], a, 30);
  EXPECT_EQ(first, csv_of(run_study(options).experiments[0], a, 30));
  options.seed = 2;
  EXPECT_NE(first, csv_of(run_study(options).experiments[0], a, 30));
}

TEST(Study, SeedsOfTrialsDiffer) {
  std::set<std::uint64_t> seeds;
  for (const Experiment& experiment : experiments()) {
    for (std::size_t point = 0; point < 17; ++point) {
      for (std::size_t trial = 0; trial < 100; ++trial) {
        seeds.insert(trial_seed(1, experiment.name, point, trial));
      }
    }
  }
  EXPECT_EQ(seeds.size(), experiments().size() * 17U * 100U);
}

TEST(Study, PointsOfASweepDrawAnew) {
  // Small errors are linear in the noise: the same draws would double them exactly.
  const Experiment& experiment = experiment_named("rapid_ground");
  const auto mean = [&](std::size_t point) {
    return run_point(experiment, point, small({}, 10)).methods[0].of(StudyMetric::kRotation).mean;
  };
  EXPECT_GT(std::abs(mean(2) / mean(1) - 2.0), 0.1);
}

TEST(Study, StatisticsAreThoseOfTheSolvedTrials) {
  const PointResult point = run_point(experiment_named("forward_ground"), 5, small({}, 400));
  ASSERT_EQ(point.methods.size(), 3U);
  EXPECT_DOUBLE_EQ(point.value, 0.5);
  for (const StudyMethodResult& method : point.methods) {
    const ErrorStatistics& errors = method.of(StudyMetric::kRotation);
    EXPECT_GT(method.solved, 380U);
    EXPECT_LE(method.solved, 400U);
    EXPECT_GT(errors.median, 0.0);
    EXPECT_GT(errors.p95, errors.median);
    EXPECT_LT(errors.mean, 180.0);
  }
}

TEST(Study, StoppedItKeepsTheFinishedExperimentsOnly) {
  std::size_t calls = 0;
  const auto stop = [&calls](double share, std::size_t trials) {
    EXPECT_EQ(trials, 5 * ++calls);
    EXPECT_GT(share, 0.0);
    return calls < 15;  // 11 points of the first experiment, four of the second
  };
  const StudyResult result = run_study(small({}, 5), stop);
  EXPECT_EQ(calls, 15U);
  ASSERT_EQ(result.experiments.size(), 1U);
  EXPECT_EQ(result.experiments[0].points.size(), 11U);
  const TemporaryFolder folder;
  EXPECT_EQ(write_study(result, {}, folder.path()).size(), 2U * 2U + 1U);
}

TEST(Study, RejectsBadOptionsByName) {
  const auto message = [](const StudyOptions& options) {
    try {
      options.validate();
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(message(small({}, 0)).find("trials"), std::string::npos);
  StudyOptions options;
  options.threads = 0;
  EXPECT_NE(message(options).find("threads"), std::string::npos);
  EXPECT_NE(message(small({"a_forward_grond_rotation"}, 1)).find("a_forward_ground_rotation"),
            std::string::npos);
  EXPECT_EQ(message(small({"all"}, 1)), "");
  EXPECT_EQ(message(small({"i1", "s5_forward_wall_normal"}, 1)), "");
  EXPECT_THROW((void)experiment_named("none"), std::invalid_argument);
}

TEST(Study, ALetterStandsForItsFigures) {
  EXPECT_EQ(wanted_figures(small({"a"}, 1)).size(), 1U);
  EXPECT_EQ(wanted_figures(small({"i"}, 1)).size(), 4U);
  EXPECT_EQ(wanted_figures(small({"s"}, 1)).size(), 10U);
  EXPECT_EQ(wanted_figures(small({"s1", "h"}, 1)).size(), 2U);
  EXPECT_EQ(wanted_figures(small({"all"}, 1)).size(), figures().size());
}

TEST(Study, FiguresHaveNamesOfTheirOwnAndExperimentsThatExist) {
  std::set<std::string> names;
  for (const Figure& figure : figures()) {
    names.insert(figure.name());
    EXPECT_NO_THROW((void)experiment_named(figure.experiment));
  }
  EXPECT_EQ(names.size(), figures().size());
}

}  // namespace
}  // namespace oneac
