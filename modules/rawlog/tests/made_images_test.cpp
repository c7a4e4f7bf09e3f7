#include "import/made_images.h"

#include "log_maker.h"

#include "oneac/base/error.h"
#include "oneac/test_support/temporary_folder.h"

#include <gtest/gtest.h>

#include <fstream>

namespace oneac {
namespace {

namespace fs = std::filesystem;

class MadeImagesBesideALog : public ::testing::Test {
 protected:
  static void write(const fs::path& file, const std::string& text) {
    fs::create_directories(file.parent_path());
    std::ofstream(file) << text;
  }
  [[nodiscard]] fs::path log() const { return folder_.path() / "x.rawlog"; }
  [[nodiscard]] fs::path images() const { return folder_.path() / "x_Images"; }
  [[nodiscard]] fs::path part() const { return folder_.path() / "x_Images.part"; }

 private:
  TemporaryFolder folder_;
};

TEST_F(MadeImagesBesideALog, LieElsewhereUntilTheyAreKept) {
  MadeImages made(log());
  write(made.folder() / "0.png", "new");
  EXPECT_FALSE(fs::exists(images()));
  made.keep();
  EXPECT_EQ(test::read_text(images() / "0.png"), "new");
  EXPECT_EQ(made.kept_path(made.folder() / "0.png"), fs::canonical(images() / "0.png").string());
}

TEST_F(MadeImagesBesideALog, ThoseOfAnEarlierImportStayWhereTheNextIsRefused) {
  write(log(), "the log");
  write(images() / "0.png", "old");
  {
    MadeImages refused(log());
    write(refused.folder() / "0.png", "new");
  }
  EXPECT_EQ(test::read_text(images() / "0.png"), "old");
  EXPECT_FALSE(fs::exists(part()));
  write(part() / "7.png", "left by one that was stopped");
  MadeImages made(log());
  write(made.folder() / "0.png", "new");
  made.keep();
  EXPECT_EQ(test::read_text(images() / "0.png"), "new");
  EXPECT_FALSE(fs::exists(images() / "7.png"));
}

TEST_F(MadeImagesBesideALog, AreOfOneLogEvenWhereItIsGone) {
  MadeImages first(log());
  write(first.folder() / "0.png", "a picture");
  first.keep();
  EXPECT_NO_THROW(MadeImages{log()}) << "somebody took the log away";
  EXPECT_NE(test::input_error([&] {
              MadeImages made(log().parent_path() / "x.log");
            }).find("not of an import of this log"),
            std::string::npos);
}

TEST_F(MadeImagesBesideALog, WhatIsNobodysImportIsRefused) {
  write(images() / "0.png", "mine");
  const std::string said = test::input_error([&] { MadeImages made(log()); });
  EXPECT_NE(said.find("x_Images: holds files that are not of an import of this log"),
            std::string::npos)
      << said;
  fs::remove_all(images());
  write(part() / "notes.txt", "mine");
  EXPECT_NE(test::input_error([&] { MadeImages made(log()); }).find("x_Images.part"),
            std::string::npos);
  EXPECT_TRUE(fs::exists(part() / "notes.txt"));
}

}  // namespace
}  // namespace oneac
