// Methods of others: what they answer is checked, and so is what they were built with.
#include "drive_fixture.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace oneac {
namespace {

namespace fs = std::filesystem;

class ForeignPlugins : public DriveFixture {
 protected:
  static constexpr std::size_t kPairs = kFrames - 1;

  void SetUp() override {
    ::unsetenv("ONEAC_BAD_ANSWER");
    ::unsetenv("ONEAC_BAD_NAME");
  }
  void TearDown() override { SetUp(); }

  [[nodiscard]] ProgramResult compare(const fs::path& plugin, const std::string& folder) const {
    return oneac_program({"compare", log(), "-o", (scratch() / folder).string(), "--plugin",
                          plugin.string(), "--initialisers", "bad,5pc"});
  }
};

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t found = 0;
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++found;
  return found;
}

TEST_F(ForeignPlugins, AnswersThatCannotBeAreFailuresByNameAndPair) {
  int answer = 0;
  for (const char* how : {"nan", "zero", "huge", "short", "status", "uncounted", "throw"}) {
    ::setenv("ONEAC_BAD_ANSWER", how, 1);
    const std::string folder = "answer-" + std::to_string(answer++);
    const ProgramResult result = compare(ONEAC_BAD_PLUGIN, folder);
    ASSERT_EQ(result.exit_code, 0) << how << ": " << result.err;
    EXPECT_NE(result.err.find("method bad: 7 of 7 answers cannot be used"), std::string::npos)
        << how << ": " << result.err;
    EXPECT_NE(result.err.find("simulated 0-1: it"), std::string::npos) << result.err;
    const std::string pairs = read_file(scratch() / folder / "pairs.csv");
    EXPECT_EQ(count(pairs, ",bad,0,invalid,"), kPairs) << how;
    EXPECT_EQ(pairs.find("nan"), std::string::npos) << how;
    EXPECT_EQ(result.out.find("nan"), std::string::npos) << how;
    EXPECT_NE(result.out.find("| **Failures** | bad | 7 |"), std::string::npos) << result.out;
  }
}

TEST_F(ForeignPlugins, AMethodThatCannotBeConfiguredIsNamed) {
  ::setenv("ONEAC_BAD_ANSWER", "configure", 1);
  for (const ProgramResult& result :
       {compare(ONEAC_BAD_PLUGIN, "configured"),
        oneac_program({"run", log(), "-o", out(), "--plugin", ONEAC_BAD_PLUGIN, "--initialiser",
                       "bad", "--no-progress"})}) {
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(count(result.err, "\n"), 1U) << result.err;
    EXPECT_NE(result.err.find("initialiser 'bad': its configure() threw"), std::string::npos)
        << result.err;
  }
}

TEST_F(ForeignPlugins, ANameThatIsTakenOrNoneIsRefused) {
  const std::vector<std::pair<const char*, const char*>> refused = {
      {"5pc", "an initialiser called 5pc, and there is one already"},
      {"", "must be a word without comma"},
      {"a,b", "must be a word without comma"},
      {"5pc+gc_ransac", "must be a word without comma, blank or +"},
      {"throw", "name() of its initialiser threw"}};
  for (const auto& [name, words] : refused) {
    ::setenv("ONEAC_BAD_NAME", name, 1);
    const ProgramResult result = compare(ONEAC_BAD_PLUGIN, "named");
    EXPECT_EQ(result.exit_code, 2) << name;
    EXPECT_NE(result.err.find(words), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("bad_initialiser"), std::string::npos) << result.err;
  }
}

TEST_F(ForeignPlugins, RunTakesThemAndUsesNoAnswerThatCannotBe) {
  for (const char* how : {"", "nan", "throw"}) {
    ::setenv("ONEAC_BAD_ANSWER", how, 1);
    const ProgramResult result =
        oneac_program({"run", log(), "-o", out(), "--plugin", ONEAC_BAD_PLUGIN, "--initialiser",
                       "bad", "--no-progress"});
    ASSERT_EQ(result.exit_code, 0) << how << ": " << result.err;
    const bool told =
        result.err.find("answers of the initialiser cannot be used") != std::string::npos;
    EXPECT_EQ(told, std::string(how) != "") << how << ": " << result.err;
    const std::string poses = read_file(fs::path(out()) / "trajectory_camera.kitti");
    EXPECT_EQ(count(poses, "\n"), static_cast<std::size_t>(kFrames));
    EXPECT_EQ(poses.find("nan"), std::string::npos) << how;
  }
}

TEST_F(ForeignPlugins, ALibraryOfAnotherBuildIsRefusedBeforeItRuns) {
  const std::string whole = read_file(ONEAC_BAD_PLUGIN);
  const std::string mark = "oneac plugin stamp <";
  const auto at = whole.find(mark);
  ASSERT_NE(at, std::string::npos);
  const auto refused = [&](std::size_t place, char value, const std::string& words) {
    std::string other = whole;
    // A copy of the mark may stand elsewhere: every stamp says the same.
    for (auto found = at; found != std::string::npos; found = other.find(mark, found + 1)) {
      other[found + place] = value;
    }
    write_text(scratch() / "other.so", other);
    const ProgramResult result = compare(scratch() / "other.so", "other");
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_NE(result.err.find(words), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("oneac_plugin()"), std::string::npos) << result.err;
  };
  constexpr std::size_t kFields = 24, kVersion = kFields + 12 * 4;
  refused(kFields + 9 * 4, 64, "alignment of Eigen");
  refused(kFields + 7 * 4, 0, "ABI of the C++ library");
  refused(kFields + 8 * 4, 1, "debug mode of the C++ library");
  refused(kVersion, '9', "was built for oneac 9");
  refused(0, 'x', "does not say which oneac");
}

TEST_F(ForeignPlugins, AComparisonDoesNotGoOnWithARebuiltLibrary) {
  ASSERT_EQ(compare(ONEAC_BAD_PLUGIN, "a").exit_code, 0);
  write_text(scratch() / "bad_initialiser.so", read_file(ONEAC_BAD_PLUGIN) + "rebuilt");
  const ProgramResult result = compare(scratch() / "bad_initialiser.so", "a");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("plugins was"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace oneac
