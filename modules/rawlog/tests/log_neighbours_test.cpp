#include "oneac/rawlog/log_neighbours.h"

#include "oneac/test_support/temporary_folder.h"

#include <gtest/gtest.h>

#include <fstream>

namespace oneac {
namespace {

namespace fs = std::filesystem;

TEST(LogNeighbours, KnowAPackedLogByItsPlainName) {
  EXPECT_EQ(bases_beside("a/drive.rawlog"), (std::vector<fs::path>{"a/drive"}));
  EXPECT_EQ(bases_beside("a/drive.rawlog.gz"),
            (std::vector<fs::path>{"a/drive.rawlog", "a/drive"}));
  EXPECT_EQ(bases_beside("drive.rawlog.zst").back(), "./drive");
}

TEST(LogNeighbours, AreLookedForWhereALinkLeads) {
  const TemporaryFolder folder;
  const fs::path far = folder.path() / "far", near = folder.path() / "near";
  fs::create_directory(far);
  fs::create_directory(near);
  std::ofstream(far / "drive.rawlog") << "x";
  fs::create_symlink("../far/drive.rawlog", near / "today.rawlog");
  EXPECT_EQ(bases_beside(near / "today.rawlog"),
            (std::vector<fs::path>{near / "today", fs::canonical(far) / "drive"}));
  EXPECT_EQ(poses_beside(near / "today.rawlog"), "");
  std::ofstream(far / "poses.txt") << "x";
  EXPECT_EQ(poses_beside(near / "today.rawlog"), (fs::canonical(far) / "poses.txt").string());
  std::ofstream(near / "today_poses.txt") << "x";
  EXPECT_EQ(poses_beside(near / "today.rawlog"), (near / "today_poses.txt").string());
}

}  // namespace
}  // namespace oneac
