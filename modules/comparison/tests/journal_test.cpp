#include "oneac/comparison/journal.h"

#include "oneac/base/error.h"
#include "oneac/test_support/temporary_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

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

LogRecord log_record() {
  LogRecord log;
  log.name = "a";
  log.images = 4;
  log.pairs = 3;
  log.last_index = 3;
  log.reference = "none";
  return log;
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
    LogRecord log = log_record();
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
    journal.add(log_record());
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

TEST(Journal, KnowsTheBuildOfProgramAndPlugins) {
  const TemporaryFolder folder;
  CompareSettings before = settings();
  before.program = "0.1.0, build 1";
  before.plugins = {"mine.so 1"};
  { const Journal journal(folder.path(), before, {}); }
  for (const bool plugin : {false, true}) {
    CompareSettings after = before;
    if (plugin) {
      after.plugins = {"mine.so 2"};
    } else {
      after.program = "0.1.0, build 2";
    }
    try {
      const Journal journal(folder.path(), after, {});
      FAIL() << "results of another build were accepted";
    } catch (const InputError& error) {
      const std::string text = error.what();
      EXPECT_NE(text.find(plugin ? "plugins was" : "program was"), std::string::npos) << text;
    }
  }
}

/// The lines of a journal of three pairs.
std::vector<std::string> written_lines() {
  const TemporaryFolder folder;
  {
    Journal journal(folder.path(), settings(), {});
    journal.add(log_record());
    for (std::size_t i = 0; i < 3; ++i) journal.add(record(i));
  }
  std::vector<std::string> lines;
  std::ifstream in(journal_path(folder.path(), {}));
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// What reading says when one text in a line is another one; "" when it is taken.
std::string refusal(std::size_t line, const std::string& from, const std::string& to) {
  std::vector<std::string> lines = written_lines();
  const auto at = lines.at(line - 1).find(from);
  if (at == std::string::npos) return "the test is wrong: no " + from + " in " + lines[line - 1];
  lines[line - 1].replace(at, from.size(), to);
  const TemporaryFolder folder;
  const fs::path path = journal_path(folder.path(), {});
  {
    std::ofstream out(path);
    for (const std::string& text : lines) out << text << '\n';
  }
  try {
    static_cast<void>(read_journal(path));
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(Journal, ChecksEveryFieldAndNamesTheLine) {
  struct Case {
    std::size_t line;
    const char *from, *to, *words;
  };
  for (const Case& c : {Case{3, "[[0,0,", "[[99,0,", "method is 99"},
                        Case{3, "[[0,0,", "[[-1,0,", "method is -1"},
                        Case{3, "[[0,0,", "[[1000000,0,", "method is 1000000"},
                        Case{3, "[[0,0,", "[[0,2,", "trial is 2"},
                        Case{3, "\"log\":0", "\"log\":-5", "log is -5"},
                        Case{3, "\"log\":0", "\"log\":1", "log is 1"},
                        Case{3, "\"pair\":0", "\"pair\":77", "pair is 77"},
                        Case{4, "\"pair\":1,\"index1\":1,\"index2\":2",
                             "\"pair\":0,\"index1\":0,\"index2\":1", "pair 0 is there twice"},
                        Case{3, "\"index2\":1", "\"index2\":99999", "index2 is 99999"},
                        Case{3, "\"index2\":1", "\"index2\":0", "below index2"},
                        Case{3, "\"index2\":1", "\"index2\":3", "less the 2 pairs behind"},
                        Case{4, "\"index1\":1", "\"index1\":0", "at least the pair's number"},
                        Case{3, "\"acs\":100", "\"acs\":69", "inliers is 70"},
                        Case{3, "\"ok\"", "\"fine\"", "status"},
                        Case{3, "\"ok\"", "\"too_few\"", "entries"},
                        Case{3, "0.125", "-1", "ms is -1"},
                        Case{3, "0.125", "1e999", "damaged"},
                        Case{3, "\"truth\":[", "\"truth\":[0,0,0,0,0,0,0],\"x\":[", "length 1"},
                        Case{3, "\"results\":[", "\"results\":[],\"x\":[", "results is 0"},
                        Case{2, "\"pairs\":3", "\"pairs\":4", "pairs is 4"},
                        Case{2, "\"name\":\"a\"", "\"name\":\"b\"", "name is"},
                        Case{2, "\"tilt\":[0", "\"tilt\":[9", "tilt is 9"},
                        Case{4, "{", "", "damaged"}}) {
    const std::string said = refusal(c.line, c.from, c.to);
    EXPECT_NE(said.find(c.words), std::string::npos) << c.from << " -> " << c.to << ": " << said;
    EXPECT_NE(said.find("line " + std::to_string(c.line)), std::string::npos) << said;
  }
}

TEST(Journal, ChecksItsHeader) {
  EXPECT_NE(refusal(1, "\"shard\":[0,1]", "\"shard\":[3,1]").find("line 1"), std::string::npos)
      << refusal(1, "\"shard\":[0,1]", "\"shard\":[3,1]");
  EXPECT_NE(refusal(1, "\"trials\":1", "\"trials\":-1").find("line 1"), std::string::npos);
  EXPECT_NE(refusal(1, "\"oneac_compare\":2", "\"oneac_compare\":1").find("another version"),
            std::string::npos);
}

TEST(Journal, ALineThatNestsWithoutEndIsDamaged) {
  const std::string deep(1000000, '[');
  const std::string closed = deep + std::string(deep.size(), ']');
  EXPECT_NE(refusal(3, "\"log\":0", "\"log\":" + closed).find("line 3"), std::string::npos);
  EXPECT_NE(refusal(1, "\"shard\":[0,1]", "\"shard\":" + closed).find("line 1"), std::string::npos);
}

TEST(Journal, AFolderInItsPlaceIsNone) {
  const TemporaryFolder folder;
  fs::create_directory(journal_path(folder.path(), {}));
  EXPECT_THROW(static_cast<void>(read_journal(journal_path(folder.path(), {}))), InputError);
  EXPECT_THROW(Journal(folder.path(), settings(), {}), InputError);
}

TEST(Journal, KeepsWhatWasWrongWithAnAnswer) {
  const TemporaryFolder folder;
  {
    Journal journal(folder.path(), settings(), {});
    journal.add(log_record());
    PairRecord pair = record(0);
    pair.results[0].has_pose = false;
    pair.results[0].status = kInvalidAnswer;
    pair.results[0].fault = "its R is no rotation";
    journal.add(pair);
  }
  const Journal again(folder.path(), settings(), {});
  EXPECT_EQ(again.content().pairs.at(0).results[0].fault, "its R is no rotation");
}

TEST(Journal, NamesTheShardsThatAreMissing) {
  JournalContent journal;
  journal.settings = settings().fingerprint();
  journal.shard = {1, 3};
  journal.logs = {log_record()};
  const std::string all = [&] {
    std::string text;
    for (const auto& line : missing_in({journal}, merge_journals(settings(), {journal}))) {
      text += line + "\n";
    }
    return text;
  }();
  EXPECT_NE(all.find("not complete: 0 of 3 pairs of 1 of 1 logs"), std::string::npos) << all;
  EXPECT_NE(all.find("no journal of shard 0/3, 2/3"), std::string::npos) << all;
  EXPECT_NE(all.find("shard 1/3 lacks 1 pairs of a"), std::string::npos) << all;
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

TEST(Journal, RefusesToMergeShardsThatSawAnotherLog) {
  JournalContent one, other;
  one.settings = other.settings = settings().fingerprint();
  one.logs = other.logs = {log_record()};
  EXPECT_NO_THROW(static_cast<void>(merge_journals(settings(), {one, other})));
  other.logs.front().tilt.pitch_up = 0.01;
  EXPECT_THROW(static_cast<void>(merge_journals(settings(), {one, other})), InputError);
}

TEST(Settings, SurviveTheJournal) {
  JournalContent content;
  content.settings = settings().fingerprint();
  EXPECT_EQ(settings_of(content).fingerprint(), content.settings);
  EXPECT_EQ(settings_of(content).features.match.snn_ratio, 0.7);
}

TEST(Settings, KeepPathsOfAnyBytes) {
  CompareSettings s = settings();
  s.logs = {
      "stra\xdf"
      "e.rawlog",
      "stra\xe4"
      "e.rawlog",
      "\xc3\xa4.rawlog"};
  JournalContent content;
  content.settings = s.fingerprint();
  EXPECT_EQ(settings_of(content).logs, s.logs);
  EXPECT_EQ(s.log_names()[0],
            "stra\xef\xbf\xbd"
            "e");
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
