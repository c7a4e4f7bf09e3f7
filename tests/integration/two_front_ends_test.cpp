#include "drive_fixture.h"

namespace oneac {
namespace {

/// Two drives through two towns; one method draws random numbers, the other does not.
class TwoFrontEnds : public DriveFixture {
 protected:
  static ProgramResult feed(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), ONEAC_FEED_LOGS);
    return run_program(arguments);
  }
  [[nodiscard]] std::string folder(const std::string& name) const {
    const auto path = scratch() / name;
    std::filesystem::create_directories(path);
    return path.string();
  }
};

TEST_F(TwoFrontEnds, InOneProcessSayWhatTwoProcessesSayToTheLastBit) {
  const std::string other = (scratch() / "other").string();
  const ProgramResult made =
      oneac_program({"simulate", "-o", other, "--frames", "12", "--seed", "7", "--width", "400",
                     "--height", "300", "--focal", "310"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const std::string other_log = other + "/simulated.rawlog";

  const std::string together = folder("together"), alone = folder("alone");
  ProgramResult fed = feed({together, log(), "1ac_pooled", other_log, "5pc"});
  ASSERT_EQ(fed.exit_code, 0) << fed.err;
  fed = feed({alone, log(), "1ac_pooled"});
  ASSERT_EQ(fed.exit_code, 0) << fed.err;
  fed = feed({alone, other_log, "5pc"});
  ASSERT_EQ(fed.exit_code, 0) << fed.err;

  for (const char* name : {"/1ac_pooled.txt", "/5pc.txt"}) {
    const std::string expected = read_file(alone + name);
    EXPECT_GT(expected.size(), 1000U) << name;
    EXPECT_TRUE(read_file(together + name) == expected) << name;
  }
}

}  // namespace
}  // namespace oneac
