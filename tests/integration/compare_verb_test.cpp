#include "drive_fixture.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>
#include <string>

namespace oneac {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
  return cells;
}

/// summary.csv without its last three columns, which are times.
std::string without_times(const std::string& summary) {
  std::string kept;
  for (std::string line : lines_of(summary)) {
    for (int i = 0; i < 3; ++i) line.resize(line.rfind(','));
    kept += line + "\n";
  }
  return kept;
}

class CompareVerb : public DriveFixture {
 protected:
  static constexpr std::size_t kPairs = kFrames - 1;

  [[nodiscard]] ProgramResult compare(const fs::path& folder,
                                      std::vector<std::string> extra = {}) const {
    std::vector<std::string> arguments{"compare", log(), "-o", folder.string()};
    if (std::find(extra.begin(), extra.end(), "--initialisers") == extra.end()) {
      arguments.insert(arguments.end(), {"--initialisers", "1ac_pooled,1ac_ground"});
    }
    arguments.insert(arguments.end(), extra.begin(), extra.end());
    return oneac_program(arguments);
  }
  [[nodiscard]] fs::path done(const std::string& name, std::vector<std::string> extra = {}) const {
    fs::path folder = scratch() / name;
    const ProgramResult result = compare(folder, std::move(extra));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return folder;
  }
  static void expect_same_results(const fs::path& a, const fs::path& b) {
    EXPECT_EQ(read_file(a / "pairs.csv"), read_file(b / "pairs.csv"));
    EXPECT_EQ(without_times(read_file(a / "summary.csv")),
              without_times(read_file(b / "summary.csv")));
  }
};

TEST_F(CompareVerb, WritesARowPerPairMethodAndTrial) {
  const fs::path out = done("a", {"--trials", "2"});
  const auto lines = lines_of(read_file(out / "pairs.csv"));
  ASSERT_EQ(lines.size(), 1 + kPairs * 2 * 2);
  EXPECT_EQ(lines[0],
            "log,index1,index2,method,trial,status,rot_err_deg,dir_err_deg,qw,qx,qy,qz,tx,ty,tz,"
            "inliers,acs,iterations,hypotheses,local_optimisations,graph_cuts");
  std::set<std::string> keys;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const auto cells = cells_of(lines[i]);
    ASSERT_EQ(cells.size(), 21U) << lines[i];
    keys.insert(cells[1] + "-" + cells[2] + cells[3] + cells[4]);
    EXPECT_LT(std::stod(cells[6]), 1.0) << lines[i];  // the simulated poses are the reference
    EXPECT_LT(std::stod(cells[7]), 15.0) << lines[i];
  }
  EXPECT_EQ(keys.size(), lines.size() - 1);
  const auto timings = lines_of(read_file(out / "timings.csv"));
  EXPECT_EQ(timings.size(), lines.size());
  EXPECT_EQ(timings[0], "log,index1,index2,method,trial,ms");
}

TEST_F(CompareVerb, GivesTheSameCorrespondencesToEveryMethod) {
  const auto lines = lines_of(read_file(done("a") / "pairs.csv"));
  for (std::size_t i = 1; i + 1 < lines.size(); i += 2) {
    EXPECT_EQ(cells_of(lines[i])[16], cells_of(lines[i + 1])[16]);
  }
}

TEST_F(CompareVerb, WritesTheTableInBothForms) {
  const fs::path out = done("a");
  const std::string md = read_file(out / "table.md");
  for (const char* title : {"Time (ms)", "Rotation (°)", "Translation (°)", "AUC@1°", "AUC@5°",
                            "AUC@10°", "Failures", "Iterations", "1ac_pooled", "1ac_ground"}) {
    EXPECT_NE(md.find(title), std::string::npos) << title;
  }
  EXPECT_NE(read_file(out / "table.tex").find("\\textbf{"), std::string::npos);
}

TEST_F(CompareVerb, GivesTheSameBytesAtOneAndTwoThreads) {
  expect_same_results(done("one", {"--threads", "1"}), done("two", {"--threads", "2"}));
}

TEST_F(CompareVerb, MergedShardsAreTheWholeComparison) {
  const fs::path whole = done("whole");
  const fs::path even = done("even", {"--shard", "0/2"});
  const fs::path odd = done("odd", {"--shard", "1/2"});
  EXPECT_LT(read_file(even / "pairs.csv").size(), read_file(whole / "pairs.csv").size());
  const fs::path merged = scratch() / "merged";
  const ProgramResult result =
      oneac_program({"compare", "--merge", odd.string(), even.string(), "-o", merged.string()});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  expect_same_results(whole, merged);
}

TEST_F(CompareVerb, NeitherGoesOnNorMergesWithOtherImages) {
  const fs::path images = scratch() / "replaced";
  fs::copy(drive() / "Images", images);
  const std::vector<std::string> flags = {"--images-dir", images.string()};
  const auto shard = [&](const char* which, const fs::path& folder) {
    std::vector<std::string> all = flags;
    all.insert(all.end(), {"--shard", which});
    return compare(folder, all);
  };
  ASSERT_EQ(shard("0/2", scratch() / "even").exit_code, 0);
  // As many images with the same names and stamps, in another order.
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(images)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  fs::rename(files[0], scratch() / "first");
  fs::rename(files[3], files[0]);
  fs::rename(scratch() / "first", files[3]);
  const ProgramResult resumed = shard("0/2", scratch() / "even");
  EXPECT_EQ(resumed.exit_code, 2);
  EXPECT_NE(resumed.err.find("other images than when the journal was begun"), std::string::npos)
      << resumed.err;
  ASSERT_EQ(shard("1/2", scratch() / "odd").exit_code, 0);
  const ProgramResult merged =
      oneac_program({"compare", "--merge", (scratch() / "even").string(),
                     (scratch() / "odd").string(), "-o", (scratch() / "merged").string()});
  EXPECT_EQ(merged.exit_code, 2);
  EXPECT_NE(merged.err.find("differently: content was"), std::string::npos) << merged.err;
}

TEST_F(CompareVerb, LeavesOutImagesThatRepeatTheOneBeforeAsRunDoes) {
  const fs::path images = scratch() / "frozen";
  fs::copy(drive() / "Images", images);
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(images)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const std::size_t frozen : {3U, 4U}) {
    fs::copy_file(files[2], files[frozen], fs::copy_options::overwrite_existing);
  }
  const std::vector<std::string> flags = {"--images-dir", images.string()};
  const fs::path whole = scratch() / "whole";
  const ProgramResult result = compare(whole, flags);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("2 images repeat the one before, pixel by pixel (first: " +
                            files[3].filename().string()),
            std::string::npos)
      << result.err;
  const auto lines = lines_of(read_file(whole / "pairs.csv"));
  ASSERT_EQ(lines.size(), 1 + (kPairs - 2) * 2);
  EXPECT_EQ(cells_of(lines[5])[1] + "-" + cells_of(lines[5])[2], "2-5");
  auto odd = flags, even = flags;
  odd.insert(odd.end(), {"--shard", "1/2"});
  even.insert(even.end(), {"--shard", "0/2"});
  ASSERT_EQ(oneac_program({"compare", "--merge", done("odd", odd).string(),
                           done("even", even).string(), "-o", (scratch() / "merged").string()})
                .exit_code,
            0);
  expect_same_results(whole, scratch() / "merged");
}

TEST_F(CompareVerb, SaysThatAShardIsMissing) {
  const fs::path even = done("even", {"--shard", "0/2"});
  const ProgramResult result =
      oneac_program({"compare", "--merge", even.string(), "-o", (scratch() / "merged").string()});
  EXPECT_EQ(result.exit_code, 2) << "a script must not take it for the whole";
  EXPECT_NE(result.err.find("not complete: 4 of 7 pairs"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("no journal of shard 1/2"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("with its --shard"), std::string::npos) << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_EQ(lines_of(read_file(scratch() / "merged" / "pairs.csv")).size(), 1 + 4 * 2)
      << "what was computed is not lost";
}

TEST_F(CompareVerb, GoesOnWhereItWasInterrupted) {
  const fs::path whole = done("whole");
  const std::string journal = read_file(whole / "journal-0of1.jsonl");
  const fs::path again = scratch() / "again";
  fs::create_directories(again);
  // A third of it, the last line torn.
  write_text(again / "journal-0of1.jsonl", journal.substr(0, journal.size() / 3));
  const std::string kept = journal.substr(0, journal.rfind('\n', journal.size() / 3));
  ASSERT_EQ(compare(again).exit_code, 0);
  expect_same_results(whole, again);
  EXPECT_EQ(read_file(again / "journal-0of1.jsonl").substr(0, kept.size()), kept);
  // Finished: everything comes from the journal, the times too.
  const std::string timings = read_file(again / "timings.csv");
  ASSERT_EQ(compare(again).exit_code, 0);
  EXPECT_EQ(read_file(again / "timings.csv"), timings);
}

TEST_F(CompareVerb, RefusesToGoOnWithOtherSettings) {
  const fs::path out = done("a");
  const ProgramResult result = compare(out, {"--trials", "3"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("trials was 1 and is now 3"), std::string::npos) << result.err;
  EXPECT_EQ(lines_of(result.err).size(), 1U);
}

TEST_F(CompareVerb, SuggestsTheNearestMethod) {
  const ProgramResult result = compare(scratch() / "a", {"--initialisers", "1ac_poled"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("1ac_pooled"), std::string::npos) << result.err;
  EXPECT_EQ(lines_of(result.err).size(), 1U);
}

TEST_F(CompareVerb, RefusesBadArgumentsInOneLine) {
  const std::vector<std::vector<std::string>> bad = {
      {"--shard", "2/2"},          {"--trials", "0"},          {"--estimators", "nonsense"},
      {"--plugin", "/no/such.so"}, {"--features", "nonsense"}, {"--set", "nonsense=1"}};
  for (const auto& extra : bad) {
    const ProgramResult result = compare(scratch() / "a", extra);
    EXPECT_EQ(result.exit_code, 2) << extra[0];
    EXPECT_EQ(lines_of(result.err).size(), 1U) << result.err;
  }
  write_text(scratch() / "no.so", "not a library");
  EXPECT_EQ(compare(scratch() / "a", {"--plugin", (scratch() / "no.so").string()}).exit_code, 2);
  EXPECT_EQ(oneac_program({"compare", "-o", out()}).exit_code, 2);
  EXPECT_EQ(oneac_program({"compare", log()}).exit_code, 2);
}

TEST_F(CompareVerb, TakesAUsersInitialiserFromAPlugin) {
  const fs::path out = done(
      "a", {"--plugin", ONEAC_EXAMPLE_PLUGIN, "--initialisers", "median_of_ground,1ac_pooled"});
  const std::string pairs = read_file(out / "pairs.csv");
  EXPECT_NE(pairs.find(",median_of_ground,0,ok,"), std::string::npos);
  EXPECT_NE(read_file(out / "report.html").find("median_of_ground"), std::string::npos);
}

TEST_F(CompareVerb, ComparesWithTheMethodsOfOtherLibraries) {
  const fs::path out =
      done("a", {"--rivals", "--initialisers", "opencv_usac_magsac,opencv_ransac"});
  const auto lines = lines_of(read_file(out / "pairs.csv"));
  ASSERT_EQ(lines.size(), 1 + 2 * kPairs);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    EXPECT_LT(std::stod(cells_of(lines[i])[6]), 1.0) << lines[i];
  }
}

TEST_F(CompareVerb, ReportNeedsNothingFromElsewhere) {
  const std::string html = read_file(done("a") / "report.html");
  for (const char* outside : {"http://", "https://", "<link", "src=\"/", "@import", "url("}) {
    EXPECT_EQ(html.find(outside), std::string::npos) << outside;
  }
  EXPECT_NE(html.find("data:image/jpeg;base64,"), std::string::npos);
  EXPECT_NE(html.find("prefers-color-scheme:dark"), std::string::npos);
  std::size_t plots = 0;
  for (auto at = html.find("<svg class=\"plot\""); at != std::string::npos;
       at = html.find("<svg class=\"plot\"", at + 1)) {
    ++plots;
  }
  EXPECT_EQ(plots, 4U);
}

TEST_F(CompareVerb, JudgesByTheGpsWherePosesAreMissing) {
  const fs::path bare = scratch() / "bare";
  fs::create_directories(bare);
  fs::copy(drive() / "simulated.rawlog", bare / "simulated.rawlog");
  const fs::path out = scratch() / "a";
  const ProgramResult result = oneac_program(
      {"compare", (bare / "simulated.rawlog").string(), "-o", out.string(), "--images-dir",
       (drive() / "Images").string(), "--initialisers", "1ac_pooled"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto lines = lines_of(read_file(out / "pairs.csv"));
  ASSERT_EQ(lines.size(), 1 + kPairs);
  for (std::size_t i = 1; i < lines.size(); ++i) EXPECT_EQ(cells_of(lines[i])[7], "");
}

TEST_F(CompareVerb, ComparesSeveralLogsAndTheirAverage) {
  const ProgramResult result = oneac_program(
      {"compare", log(), log(), "-o", out(), "--initialisers", "1ac_pooled", "--count", "4"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto lines = lines_of(read_file(fs::path(out()) / "summary.csv"));
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_EQ(cells_of(lines[1])[0], "simulated");
  EXPECT_EQ(cells_of(lines[2])[0], "simulated-2");
  EXPECT_EQ(cells_of(lines[3])[0], "average");
}

}  // namespace
}  // namespace oneac
