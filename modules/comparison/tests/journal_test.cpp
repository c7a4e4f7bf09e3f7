#include "oneac/comparison/journal.h"

#include "oneac/base/error.h"
#include "oneac/test_support/temporary_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace oneac {
namespace {

namespace fs = std::filesystem;

CompareSettings settings() {
  CompareSettings s;
  s.logs = {"a.rawlog"};
  s.methods = {{"1ac_pooled", "1ac_pooled", "consensus"}};
  s.features.match.snn_ratio = 0.7;
  s.seed = 12;
  return s;
}

PairRecord record(std::size_t ordinal) {
  PairRecord pair;
  pair.ordinal = ordinal;
  pair.index1 = ordinal;
  pair.index2 = ordinal + 1;
  pair.acs = 100;
  pair.truth = RelativePose{yaw_rotation(0.8, 0.6), {0.1, 0.2, -1.0 / 3.0}};
  MethodResult result;
  result.status = "ok";
  result.has_pose = true;
  result.pose = {yaw_rotation(0.6, 0.8), {0.0, 0.0, -1.0}};
  result.inliers = 70;
  result.iterations = 99;
  result.ms = 0.125;
  pair.results = {result};
  return pair;
}

TEST(Journal, ReadsBackWhatItWrote) {
  const TemporaryFolder folder;
  {
    Journal journal(folder.path(), settings(), {});
    LogRecord log;
    log.name = "a";
    log.pairs = 2;
    log.tilt.pitch_up = 0.1;
    journal.add(log);
    journal.add(record(0));
  }
  const Journal again(folder.path(), settings(), {});
  ASSERT_EQ(again.content().pairs.size(), 1U);
  const PairRecord& pair = again.content().pairs.front();
  EXPECT_TRUE(again.has(0, 0));
  EXPECT_FALSE(again.has(0, 1));
  EXPECT_EQ(again.log(0)->tilt.pitch_up, 0.1);
  EXPECT_EQ(pair.truth->t.z(), -1.0 / 3.0);
  EXPECT_TRUE(pair.results[0].pose.R.isApprox(yaw_rotation(0.6, 0.8)));
  EXPECT_EQ(pair.results[0].iterations, 99U);
  EXPECT_EQ(pair.results[0].ms, 0.125);
}

TEST(Journal, CutsATornLineOffAndGoesOn) {
  const TemporaryFolder folder;
  {
    Journal journal(folder.path(), settings(), {});
    journal.add(record(0));
    journal.add(record(1));
  }
  const fs::path path = journal_path(folder.path(), {});
  fs::resize_file(path, fs::file_size(path) - 10);
  {
    Journal journal(folder.path(), settings(), {});
    EXPECT_EQ(journal.content().pairs.size(), 1U);
    journal.add(record(1));
  }
  EXPECT_EQ(read_journal(path).pairs.size(), 2U);
}

TEST(Journal, NamesTheSettingThatDiffers) {
  const TemporaryFolder folder;
  { const Journal journal(folder.path(), settings(), {}); }
  CompareSettings other = settings();
  other.seed = 13;
  try {
    const Journal journal(folder.path(), other, {});
    FAIL() << "other settings were accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("seed was 12 and is now 13"), std::string::npos)
        << error.what();
  }
}

TEST(Journal, RefusesAFileOfAnotherKind) {
  const TemporaryFolder folder;
  std::ofstream(journal_path(folder.path(), {})) << "hello\n";
  EXPECT_THROW(Journal(folder.path(), settings(), {}), InputError);
}

TEST(Journal, MergesShardsInTheOrderOfPairs) {
  JournalContent even, odd;
  even.settings = odd.settings = settings().fingerprint();
  even.pairs = {record(0), record(2)};
  odd.pairs = {record(1), record(2)};
  const ComparisonData data = merge_journals(settings(), {odd, even});
  ASSERT_EQ(data.pairs.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(data.pairs[i].ordinal, i);
}

TEST(Journal, RefusesToMergeDifferentComparisons) {
  JournalContent one, other;
  one.settings = settings().fingerprint();
  CompareSettings changed = settings();
  changed.trials = 3;
  other.settings = changed.fingerprint();
  EXPECT_THROW(static_cast<void>(merge_journals(settings(), {one, other})), InputError);
}

TEST(Settings, SurviveTheJournal) {
  JournalContent content;
  content.settings = settings().fingerprint();
  EXPECT_EQ(settings_of(content).fingerprint(), content.settings);
  EXPECT_EQ(settings_of(content).features.match.snn_ratio, 0.7);
}

TEST(Settings, NameLogsApartAndWithoutCommas) {
  CompareSettings s;
  s.logs = {"/x/drive.rawlog", "/y/drive.rawlog.gz", "/z/a,b.rawlog"};
  EXPECT_EQ(s.log_names(), (std::vector<std::string>{"drive", "drive-2", "a_b"}));
}

TEST(Shard, DealsEveryPairOnce) {
  for (std::size_t pair = 0; pair < 20; ++pair) {
    int owners = 0;
    for (const char* text : {"0/3", "1/3", "2/3"}) owners += parse_shard(text).has(pair) ? 1 : 0;
    EXPECT_EQ(owners, 1) << pair;
  }
}

TEST(Shard, RefusesWhatIsNoShard) {
  for (const char* text : {"", "1", "3/3", "-1/3", "a/b", "1/0", "1/2x"}) {
    EXPECT_THROW(static_cast<void>(parse_shard(text)), InputError) << text;
  }
}

}  // namespace
}  // namespace oneac
