#pragma once

#include "oneac/test_support/program.h"
#include "oneac/test_support/temporary_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace oneac {

/// Runs the program under test.
[[nodiscard]] ProgramResult oneac_program(std::vector<std::string> arguments);

[[nodiscard]] std::string read_file(const std::filesystem::path& path);
void write_text(const std::filesystem::path& path, const std::string& text);

/// A short simulated drive, rendered once per suite, and a scratch folder per test.
class DriveFixture : public ::testing::Test {
 protected:
  static constexpr int kFrames = 8;

  static void SetUpTestSuite();
  static void TearDownTestSuite();

  [[nodiscard]] static std::filesystem::path drive() { return shared_->path() / "drive"; }
  [[nodiscard]] static std::string log() { return (drive() / "simulated.rawlog").string(); }
  [[nodiscard]] std::filesystem::path scratch() const { return scratch_.path(); }
  [[nodiscard]] std::string out() const { return (scratch_.path() / "out").string(); }

 private:
  static std::unique_ptr<TemporaryFolder> shared_;
  TemporaryFolder scratch_;
};

}  // namespace oneac
