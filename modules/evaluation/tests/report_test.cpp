#include "oneac/evaluation/report.h"

#include "evaluation_test_tools.h"

#include <nlohmann/json.hpp>

namespace oneac {
namespace {

constexpr double kDegree = 0.017453292519943295;

/// Three pairs: exact, up to scale and in a wrong basin, standing.
Evaluation some_pairs() {
  std::vector<RelativePoseRow> rows(3);
  for (std::size_t k = 0; k < 3; ++k) {
    rows[k].index1 = k;
    rows[k].index2 = k + 1;
  }
  rows[0].T_2_1.t << 0, 0, -2.2;
  rows[0].metric = true;
  rows[1].T_2_1.t << 0, 0, 1;
  Trajectory reference;
  reference.poses = {pose_at(0, 0, 0), pose_at(0, 0, 2), pose_at(0, 0, 4), pose_at(0, 0, 4)};
  return evaluate_pairs(rows, reference);
}

Evaluation some_trajectory() {
  Evaluation evaluation;
  const auto truth = straight_drive(300, 1.0);
  evaluation.trajectory = trajectory_errors({straight_drive(300, 1.1), truth}, Alignment::kSim3);
  evaluation.estimate_frames = 300;
  evaluation.reference_frames = 301;
  return evaluation;
}

TEST(FormatTable, SummarisesPairs) {
  const std::string text = format_table(some_pairs(), false);
  expect_contains(text, "pairs                           3  0 more without a reference\n");
  expect_contains(text, "bad                             1");
  expect_contains(text, "length error [%]          10.0000    10.0000");
  expect_contains(text, "direction [deg]           90.0000    90.0000   171.0000");
  EXPECT_EQ(text.find("index1"), std::string::npos);
}

TEST(FormatTable, ListsPairsOnRequest) {
  const std::string text = format_table(some_pairs(), true);
  expect_contains(text, "index1     index2     step_m");
  expect_contains(text, "0          1     2.0000     0.0000     0.0000    10.0000\n");
  expect_contains(text, "1          2     2.0000     0.0000   180.0000          -  bad\n");
  expect_contains(text, "2          3     0.0000     0.0000          -          -\n");
}

TEST(FormatTable, SummarisesATrajectory) {
  const std::string text = format_table(some_trajectory(), false);
  expect_contains(text, "300  of 300 estimated, 301 in the reference");
  expect_contains(text, "t_rel [%]                 10.0000\n");
  expect_contains(text, "scale error [%]           10.0000\n");
  expect_contains(text, "scale applied              0.9091\n");
  expect_contains(text, "APE sim3 [m]               0.0000");
}

TEST(FormatJson, CarriesUnitsInItsKeysAndNullForWhatIsNotDefined) {
  const auto json = nlohmann::json::parse(format_json(some_pairs(), true));
  EXPECT_EQ(json.at("pairs").size(), 3U);
  EXPECT_NEAR(json["pairs"][1].at("direction_deg").get<double>(), 180.0, 1e-9);
  EXPECT_TRUE(json["pairs"][1].at("bad").get<bool>());
  EXPECT_TRUE(json["pairs"][2].at("direction_deg").is_null());
  EXPECT_EQ(json.at("pair_summary").at("bad"), 1);
  EXPECT_NEAR(json["pair_summary"]["length_error_percent"]["median"].get<double>(), 10.0, 1e-9);
  EXPECT_FALSE(json.contains("trajectory"));
}

TEST(FormatJson, DescribesATrajectory) {
  const auto json = nlohmann::json::parse(format_json(some_trajectory(), false));
  EXPECT_FALSE(json.contains("pairs"));
  EXPECT_NEAR(json.at("trajectory").at("t_rel_percent").get<double>(), 10.0, 1e-9);
  EXPECT_NEAR(json["trajectory"].at("aligned_scale").get<double>(), 1.0 / 1.1, 1e-9);
  EXPECT_EQ(json["trajectory"].at("alignment"), "sim3");
}

TEST(FormatJson, GivesRotationsPer100Metres) {
  Evaluation evaluation = some_trajectory();
  evaluation.trajectory->subsequences->rotation = 0.02 * kDegree;
  const auto json = nlohmann::json::parse(format_json(evaluation, false));
  EXPECT_NEAR(json["trajectory"].at("r_rel_deg_per_100m").get<double>(), 2.0, 1e-9);
  expect_contains(format_table(evaluation, false), "r_rel [deg/100 m]          2.0000\n");
}

}  // namespace
}  // namespace oneac
