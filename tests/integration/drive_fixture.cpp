#include "drive_fixture.h"

#include <fstream>
#include <iterator>
#include <stdexcept>

namespace oneac {

std::unique_ptr<TemporaryFolder> DriveFixture::shared_;

ProgramResult oneac_program(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), ONEAC_PROGRAM);
  return run_program(arguments);
}

std::string read_file(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

void DriveFixture::SetUpTestSuite() {
  shared_ = std::make_unique<TemporaryFolder>();
  const ProgramResult made =
      oneac_program({"simulate", "-o", drive().string(), "--frames", std::to_string(kFrames),
                     "--width", "320", "--height", "240", "--focal", "250"});
  if (made.exit_code != 0) throw std::runtime_error("simulate failed: " + made.err);
}

void DriveFixture::TearDownTestSuite() {
  shared_.reset();
}

}  // namespace oneac
