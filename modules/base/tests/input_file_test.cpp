#include "oneac/base/input_file.h"

#include "oneac/base/error.h"
#include "oneac/test_support/temporary_folder.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <iterator>
#include <string>
#include <utility>

namespace oneac {
namespace {

namespace fs = std::filesystem;

TEST(InputFile, TakesFilesAndLinksToThem) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "a") << "x";
  fs::create_symlink("a", folder.path() / "link");
  EXPECT_EQ(fault_of_file(folder.path() / "a"), "");
  EXPECT_EQ(fault_of_file(folder.path() / "link"), "");
}

TEST(InputFile, APlaceForAFileIsEmptyOrHoldsOne) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "a") << "x";
  EXPECT_EQ(fault_of_place(folder.path() / "a"), "");
  EXPECT_EQ(fault_of_place(folder.path() / "nothing"), "");
  EXPECT_EQ(fault_of_place(folder.path()), "is a folder");
}

TEST(InputFile, AFileIsTheSameByWhateverWay) {
  const TemporaryFolder folder;
  const fs::path a = folder.path() / "a";
  std::ofstream(a) << "x";
  std::ofstream(folder.path() / "b") << "x";
  fs::create_symlink("a", folder.path() / "link");
  EXPECT_TRUE(is_same_file(a, a));
  EXPECT_TRUE(is_same_file(a, folder.path() / "link"));
  EXPECT_TRUE(is_same_file(a, folder.path() / "." / "a"));
  EXPECT_FALSE(is_same_file(a, folder.path() / "b"));
  EXPECT_FALSE(is_same_file(a, folder.path() / "nothing"));
  EXPECT_TRUE(is_same_file(folder.path() / "nothing", folder.path() / "nothing"));
}

TEST(InputFile, TellsHowAFileBegins) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "a") << "long";
  EXPECT_EQ(beginning_of(folder.path() / "a", 2), "lo");
  EXPECT_EQ(beginning_of(folder.path() / "a", 9), "long");
  EXPECT_EQ(beginning_of(folder.path() / "nothing", 9), "");
  EXPECT_EQ(beginning_of(folder.path(), 9), "");
}

TEST(InputFile, SaysWhatElseAPathIs) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo((folder.path() / "pipe").c_str(), 0600), 0);
  fs::create_symlink("loop", folder.path() / "loop");
  EXPECT_EQ(fault_of_file(folder.path() / "none"), "no such file");
  EXPECT_EQ(fault_of_file(folder.path()), "is a folder");
  EXPECT_EQ(fault_of_file(folder.path() / "pipe"), "is a pipe, a device or a socket, not a file");
  EXPECT_NE(fault_of_file(folder.path() / "loop").find("cannot be read ("), std::string::npos);
}

TEST(InputFile, ByteOrderMarksAreTakenAwayAtTheBeginAlone) {
  for (const auto& [text, expected] :
       {std::pair<std::string, std::string>{"\xEF\xBB\xBFtime", "time"},
        {"time", "time"},
        {"a\xEF\xBB\xBF", "a\xEF\xBB\xBF"},
        {"\xEF\xBB", "\xEF\xBB"},
        {"", ""}}) {
    std::string found = text;
    drop_byte_order_mark(found);
    EXPECT_EQ(found, expected);
  }
}

TEST(InputFile, OpensFilesAndRefusesTheRest) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "a", std::ios::binary) << "one\r\n";
  std::ifstream stream = open_input(folder.path() / "a", "look");
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(stream), {}), "one\r\n");
  ASSERT_EQ(::mkfifo((folder.path() / "pipe").c_str(), 0600), 0);
  EXPECT_THROW(static_cast<void>(open_input(folder.path() / "pipe", "look")), InputError);
  EXPECT_THROW(static_cast<void>(open_input(folder.path() / "none", "look")), InputError);
}

TEST(InputFile, HashTellsContentsApart) {
  const TemporaryFolder folder;
  const auto hash = [&](const std::string& content) {
    std::ofstream(folder.path() / "a", std::ios::binary) << content;
    return content_hash(folder.path() / "a");
  };
  EXPECT_EQ(hash("one").size(), 16U);
  EXPECT_EQ(hash("one"), hash("one"));
  EXPECT_NE(hash("one"), hash("two"));
  EXPECT_NE(hash("one"), hash(std::string("one\0", 4)));
  EXPECT_NE(hash(std::string(3000000, 'a')), hash(std::string(2999999, 'a') + "b"));
  EXPECT_EQ(content_hash(folder.path() / "none"), "");
}

}  // namespace
}  // namespace oneac
