#include "oneac/base/atomic_file.h"

#include "oneac/base/error.h"
#include "oneac/test_support/temporary_folder.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

namespace oneac {
namespace {

std::string content_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::size_t entries_in(const std::filesystem::path& folder) {
  using Iterator = std::filesystem::directory_iterator;
  return static_cast<std::size_t>(std::distance(Iterator(folder), Iterator{}));
}

TEST(AtomicFile, ReplacesTheOldContentAndLeavesNoTemporary) {
  const TemporaryFolder folder;
  write_file_atomically(folder.path() / "a.txt", "old and longer");
  write_file_atomically(folder.path() / "a.txt", "new");
  EXPECT_EQ(content_of(folder.path() / "a.txt"), "new");
  EXPECT_EQ(entries_in(folder.path()), 1U);
}

TEST(AtomicFile, KeepsTheOldFileWhenTheProducerThrows) {
  const TemporaryFolder folder;
  write_file_atomically(folder.path() / "a.txt", "old");
  const auto fail = [](std::ostream& out) {
    out << "half";
    throw std::runtime_error("interrupted");
  };
  EXPECT_THROW(write_file_atomically(folder.path() / "a.txt", fail), std::runtime_error);
  EXPECT_EQ(content_of(folder.path() / "a.txt"), "old");
  EXPECT_EQ(entries_in(folder.path()), 1U);
}

TEST(AtomicFile, NamesThePathThatCannotBeWritten) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "missing" / "a.txt";
  try {
    write_file_atomically(path, "x");
    FAIL() << "must throw";
  } catch (const OutputError& error) {
    EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos) << error.what();
  }
}

TEST(AtomicFile, WritesThroughALinkAndLeavesIt) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "far");
  std::filesystem::create_symlink("far/a.txt", folder.path() / "link");
  write_file_atomically(folder.path() / "link", "first");  // dangling so far
  write_file_atomically(folder.path() / "link", "second");
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "link"));
  EXPECT_EQ(content_of(folder.path() / "far" / "a.txt"), "second");
}

TEST(AtomicFile, ReplacesNothingButFiles) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo((folder.path() / "pipe").c_str(), 0600), 0);
  std::filesystem::create_symlink("/dev/null", folder.path() / "null");
  std::filesystem::create_symlink("loop", folder.path() / "loop");
  for (const char* name : {"pipe", "null", "loop", "."}) {
    EXPECT_THROW(write_file_atomically(folder.path() / name, "x"), OutputError) << name;
  }
  EXPECT_TRUE(std::filesystem::is_fifo(folder.path() / "pipe"));
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(RequireWritableFolder, SaysWhyALoopOrALongNameIsNone) {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("loop", folder.path() / "loop");
  EXPECT_THROW(require_writable_folder(folder.path() / "loop"), InputError);
  EXPECT_THROW(require_writable_folder(folder.path() / std::string(300, 'a')), InputError);
}

TEST(RequireWritableFolder, MakesMissingParents) {
  const TemporaryFolder folder;
  require_writable_folder(folder.path() / "a" / "b");
  EXPECT_TRUE(std::filesystem::is_directory(folder.path() / "a" / "b"));
  EXPECT_EQ(entries_in(folder.path() / "a" / "b"), 0U);
}

TEST(RequireWritableFolder, RefusesAFileInItsPlace) {
  const TemporaryFolder folder;
  write_file_atomically(folder.path() / "file", "x");
  EXPECT_THROW(require_writable_folder(folder.path() / "file"), InputError);
}

}  // namespace
}  // namespace oneac
