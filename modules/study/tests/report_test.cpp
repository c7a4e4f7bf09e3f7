#include "oneac/study/report.h"

#include "oneac/study/readings.h"
#include "oneac/test_support/temporary_folder.h"

#include <gtest/gtest.h>

#include <sstream>
#include <vector>

namespace oneac {
namespace {

StudyOptions small(std::vector<std::string> figures) {
  StudyOptions options;
  options.figures = std::move(figures);
  options.trials = 40;
  return options;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST(StudyReport, CsvHasARowPerPointAndMethod) {
  const StudyResult result = run_study(small({"e"}));
  const Figure figure = wanted_figures(result.options).front();
  const auto lines = lines_of(csv_of(result.experiments[0], figure, 40));
  ASSERT_EQ(lines.size(), 1U + 17U * 3U);
  EXPECT_EQ(lines[0], "wall_angle_deg,method,trials,failures,mean_deg,median_deg,p95_deg");
  EXPECT_EQ(lines[1].rfind("-80.0,1AC wall,40,", 0), 0U) << lines[1];
  EXPECT_EQ(lines[2].rfind("-80.0,4PC,40,", 0), 0U);
  EXPECT_EQ(lines.back().rfind("80.0,2AC,40,", 0), 0U);
}

TEST(StudyReport, CsvNamesItsSweep) {
  const StudyResult result = run_study(small({"a", "i1"}));
  EXPECT_EQ(csv_of(*result.find("forward_ground"), figures()[0], 40).rfind("noise_px,", 0), 0U);
  EXPECT_EQ(csv_of(*result.find("tilt_ground"), figures()[0], 40).rfind("tilt_deg,", 0), 0U);
}

TEST(StudyReport, CsvShowsTheErrorOfItsFigure) {
  const StudyResult result = run_study(small({"a", "b"}));
  const auto wanted = wanted_figures(result.options);
  const StudyMethodResult& ours = result.experiments[0].points[10].methods[0];
  std::istringstream row(lines_of(csv_of(result.experiments[0], wanted[1], 40))[31]);
  std::vector<std::string> cells;
  for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
  ASSERT_EQ(cells.size(), 7U);
  EXPECT_EQ(cells[1], "1AC ground");
  EXPECT_NEAR(std::stod(cells[4]), ours.of(StudyMetric::kTranslation).mean, 1e-5);
  EXPECT_EQ(std::stoul(cells[3]), 40 - ours.solved);
}

TEST(StudyReport, SvgNamesMethodsErrorAndUnits) {
  const StudyResult result = run_study(small({"d"}));
  const std::string svg =
      svg_of(result.experiments[0], wanted_figures(result.options).front(), DataUse::kAll);
  for (const char* part : {"(d) Forward motion, frontal wall", "1AC front wall", "4PC", "2AC",
                           "mean translation error [°]", "point noise [px]", "same four"}) {
    EXPECT_NE(svg.find(part), std::string::npos) << part;
  }
}

TEST(StudyReport, SummarySaysPlainlyWhereItDisagrees) {
  StudyOptions options = small({"c"});
  options.data_use = DataUse::kMinimal;
  options.noise_shape = NoiseShape::kFixed;
  const std::string summary = summary_of(run_study(options), {});
  EXPECT_NE(summary.find("**Our result disagrees with the paper**"), std::string::npos);
  EXPECT_NE(summary.find("**not so:** Forward motion, frontal wall, rotation"), std::string::npos);
  EXPECT_NE(summary.find("4PC wins in rotation from the lowest noise on"), std::string::npos);
  EXPECT_EQ(summary.find("## Under every reading"), std::string::npos);
}

TEST(StudyReport, SummaryHasARowPerReadingAndATablePerFigure) {
  const StudyOptions options = small({"a", "b"});
  const std::string summary = summary_of(run_study(options), run_readings(options));
  for (const Reading& reading : readings()) {
    EXPECT_NE(summary.find("| " + std::string(reading.meaning) + " |"), std::string::npos);
  }
  EXPECT_NE(summary.find("| rotation error [°] at | 0.0 px | 0.2 px |"), std::string::npos);
  EXPECT_NE(summary.find("| translation error [°] at |"), std::string::npos);
  EXPECT_NE(summary.find("(a_forward_ground_rotation.svg)"), std::string::npos);
  EXPECT_NE(summary.find("40 trials a point, seed 1"), std::string::npos);
}

}  // namespace
}  // namespace oneac
