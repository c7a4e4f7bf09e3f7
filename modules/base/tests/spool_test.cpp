#include "oneac/base/error.h"
#include "oneac/base/spooled_vector.h"
#include "oneac/test_support/temporary_folder.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

namespace oneac {
namespace {

struct Entry {
  std::size_t number = 0;
  double values[3] = {};
  std::optional<double> more;
};

struct EntryFields {
  template <class Archive, class Value>
  static void visit(Archive& archive, Value& entry) {
    archive(entry.number);
    archive.array(entry.values, 3);
    archive(entry.more);
  }
};

using Entries = SpooledVector<Entry, EntryFields>;

constexpr std::size_t kMemory = 4096;  // [byte] some eighty of them
constexpr std::size_t kMany = 5000;

Entry entry(std::size_t i) {
  Entry made{i, {0.5 * static_cast<double>(i), -1.0, 1e300}, std::nullopt};
  if (i % 3 == 0) made.more = static_cast<double>(i);
  return made;
}

bool is_entry(const Entry& found, std::size_t i) {
  const Entry wanted = entry(i);
  return found.number == i && std::equal(found.values, found.values + 3, wanted.values) &&
         found.more == wanted.more;
}

Entries many(const std::filesystem::path& folder, std::size_t count = kMany) {
  Entries entries(folder, kMemory);
  for (std::size_t i = 0; i < count; ++i) entries.push_back(entry(i));
  return entries;
}

std::size_t wrong_ones(const Entries& entries) {
  std::size_t wrong = 0, i = 0;
  for (const Entry& found : entries) wrong += is_entry(found, i++) ? 0 : 1;
  return wrong;
}

TEST(Spool, GivesBackWhatHasLeftMemory) {
  const TemporaryFolder folder;
  const Entries entries = many(folder.path());
  ASSERT_EQ(entries.size(), kMany);
  EXPECT_TRUE(entries.uses_file());
  EXPECT_EQ(wrong_ones(entries), 0U);
  for (std::size_t i = kMany; i-- > 0;) ASSERT_TRUE(is_entry(entries[i], i)) << i;
  for (std::size_t i = 0; i < kMany; i = 3 * i + 1) EXPECT_TRUE(is_entry(entries.at(i), i)) << i;
}

TEST(Spool, LeavesNothingInItsFolder) {
  const TemporaryFolder folder;
  const Entries entries = many(folder.path());
  ASSERT_TRUE(entries.uses_file());
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Spool, MakesNoFileForWhatFitsIntoMemory) {
  EXPECT_FALSE(many("/", 50).uses_file());
}

TEST(Spool, KeepsChangesWhereverTheRecordIs) {
  const TemporaryFolder folder;
  Entries entries = many(folder.path());
  entries.replace(7, entry(70));
  entries.replace(kMany - 1, entry(71));
  EXPECT_TRUE(is_entry(entries[7], 70));
  entries.change_all([](Entry& changed) { changed.values[1] = 2.0; });
  for (const Entry& found : entries) ASSERT_EQ(found.values[1], 2.0);
  EXPECT_EQ(entries[7].number, 70U);
  EXPECT_EQ(entries.back().number, 71U);
}

TEST(Spool, KeepsEverythingInMemoryWhereNoFileCanBeMade) {
  const Entries entries = many("/nowhere/at/all");
  EXPECT_FALSE(entries.uses_file());
  EXPECT_EQ(wrong_ones(entries), 0U);
}

TEST(Spool, LosesNothingWhenTheDiskIsFull) {
  const TemporaryFolder folder;
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit small = before;
  small.rlim_cur = 10'000;
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  Entries entries = many(folder.path());
  entries.replace(0, entry(0));
  EXPECT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(wrong_ones(entries), 0U);
}

TEST(Spool, IsReadBySeveralThreadsAtOnce) {
  const TemporaryFolder folder;
  const Entries entries = many(folder.path());
  std::size_t wrong[2] = {1, 1};
  std::thread other([&] { wrong[0] = wrong_ones(entries); });
  wrong[1] = wrong_ones(entries);
  other.join();
  EXPECT_EQ(wrong[0] + wrong[1], 0U);
}

TEST(Spool, MovesWithItsFile) {
  const TemporaryFolder folder;
  Entries entries = many(folder.path());
  Entries moved(std::move(entries));
  EXPECT_EQ(wrong_ones(moved), 0U);
  Entries assigned;
  assigned = std::move(moved);
  EXPECT_EQ(assigned.size(), kMany);
  EXPECT_EQ(wrong_ones(assigned), 0U);
}

TEST(Spool, RefusesWhatIsNotThere) {
  Entries entries;
  EXPECT_THROW((void)entries[0], std::out_of_range);
  EXPECT_THROW(entries.replace(0, entry(0)), std::out_of_range);
  EXPECT_THROW(Spool({}, 0), std::invalid_argument);
}

}  // namespace
}  // namespace oneac
