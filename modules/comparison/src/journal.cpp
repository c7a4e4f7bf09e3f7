#include "oneac/comparison/journal.h"

#include "record_json.h"

#include "oneac/base/error.h"
#include "oneac/base/input_file.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

namespace oneac {
namespace {

namespace fs = std::filesystem;
using internal::Json;

constexpr const char* kMark = "oneac_compare";
constexpr int kVersion = 2;

Json header(const std::string& settings, const Shard& shard) {
  Json json;
  json[kMark] = kVersion;
  json["shard"] = {shard.index, shard.count};
  json["settings"] = Json::parse(settings);
  return json;
}

[[noreturn]] void no_journal(const fs::path& path) {
  throw InputError(path.string(), "is not a journal of oneac compare", "give another folder");
}

/// Deeper than any line of ours; the JSON library copies what it reads by recursion.
bool nests_deep(const std::string& line) {
  constexpr int kDeepest = 16;
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (quoted && line[i] == '\\') {
      ++i;
    } else if (line[i] == '"') {
      quoted = !quoted;
    } else if (!quoted && (line[i] == '[' || line[i] == '{')) {
      if (++depth > kDeepest) return true;
    } else if (!quoted && (line[i] == ']' || line[i] == '}')) {
      --depth;
    }
  }
  return false;
}

/// Takes the lines of one journal, the header first.
class JournalReader {
 public:
  JournalReader(const fs::path& path, JournalContent& content) : path_(path), content_(content) {}

  void take(const std::string& line) {
    ++number_;
    if (nests_deep(line)) refuse("is damaged");
    try {
      take_json(Json::parse(line));
    } catch (const Json::exception&) {
      if (number_ == 1) no_journal(path_);
      refuse("is damaged");
    } catch (const std::invalid_argument& error) {
      refuse(error.what());
    }
  }

 private:
  /// For take(), which knows the line.
  [[noreturn]] static void fail(const std::string& fault) { throw std::invalid_argument(fault); }

  [[noreturn]] void refuse(const std::string& fault) const {
    throw InputError(path_.string() + ": line " + std::to_string(number_), fault,
                     "take the line away to have it computed again, or choose an empty folder");
  }

  void take_json(const Json& json) {
    if (number_ == 1) return take_header(json);
    if (json.contains("name")) return take_log(json);
    const std::size_t log = internal::log_of_pair(json, settings_);
    const LogRecord* const known = log_record(log);
    if (known == nullptr) fail("is a pair of log " + std::to_string(log) + ", not told before");
    PairRecord pair = internal::pair_from(json, settings_, *known);
    const std::string name = "pair " + std::to_string(pair.ordinal);
    if (!content_.shard.has(pair.ordinal)) fail(name + " is not of this shard");
    if (!seen_.emplace(pair.log, pair.ordinal).second) fail(name + " is there twice");
    content_.pairs.push_back(std::move(pair));
  }

  void take_header(const Json& json) {
    if (!json.is_object() || !json.contains(kMark)) no_journal(path_);
    if (json[kMark] != kVersion) {
      fail("was written by another version of oneac");
    }
    const Json& shard = json.at("shard");
    if (!shard.at(0).is_number() || !shard.at(1).is_number()) fail("names no shard");
    try {
      content_.shard =
          parse_shard(internal::text_of(shard.at(0)) + "/" + internal::text_of(shard.at(1)));
      settings_ = internal::settings_from(json.at("settings"));
    } catch (const InputError& error) {
      fail(error.what());
    }
    content_.settings = settings_.fingerprint();
  }

  void take_log(const Json& json) {
    LogRecord record = internal::log_from(json, settings_);
    if (log_record(record.log) != nullptr) fail("tells log " + record.name + " twice");
    content_.logs.push_back(std::move(record));
  }

  [[nodiscard]] const LogRecord* log_record(std::size_t log) const {
    const auto found = std::find_if(content_.logs.begin(), content_.logs.end(),
                                    [&](const LogRecord& record) { return record.log == log; });
    return found == content_.logs.end() ? nullptr : &*found;
  }

  const fs::path& path_;
  JournalContent& content_;
  CompareSettings settings_;
  std::set<std::pair<std::size_t, std::size_t>> seen_;
  std::size_t number_ = 0;
};

/// The first key in which two fingerprints differ, with both values.
std::string difference(const std::string& before, const std::string& now) {
  const Json a = Json::parse(before);
  const Json b = Json::parse(now);
  for (const auto& [key, value] : b.items()) {
    const Json old = a.contains(key) ? a.at(key) : Json();
    if (old != value) {
      return key + " was " + internal::text_of(old) + " and is now " + internal::text_of(value);
    }
  }
  return "the settings differ";
}

/// Two machines' arithmetic may differ in the last digits of what a log teaches.
bool same(const LogRecord& a, const LogRecord& b) {
  constexpr double kRounding = 1e-6;
  LogRecord with_its_numbers = b;
  with_its_numbers.tilt = a.tilt;
  with_its_numbers.course_sigma_deg = a.course_sigma_deg;
  with_its_numbers.heading_sigma_deg = a.heading_sigma_deg;
  with_its_numbers.heading_vs_gyro_deg = a.heading_vs_gyro_deg;
  return internal::to_json(a) == internal::to_json(with_its_numbers) &&
         std::abs(a.tilt.pitch_up - b.tilt.pitch_up) < kRounding &&
         std::abs(a.tilt.roll_right - b.tilt.roll_right) < kRounding;
}

/// What two shards say of one log is the same, or they have seen different ones.
void require_same_logs(const std::vector<LogRecord>& some, const std::vector<LogRecord>& others) {
  for (const LogRecord& a : some) {
    for (const LogRecord& b : others) {
      if (a.log != b.log || same(a, b)) continue;
      const std::string first = internal::text_of(internal::to_json(b));
      const std::string second = internal::text_of(internal::to_json(a));
      throw InputError(
          "--merge",
          "the journals tell log " + a.name + " differently: " + difference(first, second),
          "merge shards of one comparison, of the same images");
    }
  }
}

}  // namespace

JournalContent read_journal(const fs::path& path) {
  if (const std::string fault = fault_of_file(path); !fault.empty()) {
    throw InputError(path.string(), fault, "a journal is a file; give another folder");
  }
  JournalContent content;
  std::ifstream in(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  JournalReader reader(path, content);
  std::size_t begin = 0;
  for (std::size_t end = 0; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1) {
    reader.take(text.substr(begin, end - begin));
  }
  content.whole_bytes = begin;
  return content;
}

fs::path journal_path(const fs::path& folder, const Shard& shard) {
  return folder / ("journal-" + shard.name() + ".jsonl");
}

std::vector<fs::path> find_journals(const std::vector<fs::path>& folders) {
  std::vector<fs::path> found;
  for (const fs::path& folder : folders) {
    std::vector<fs::path> here;
    std::error_code ignored;
    if (fs::is_directory(folder, ignored)) {
      for (const auto& entry : fs::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        if (name.rfind("journal-", 0) == 0 && entry.path().extension() == ".jsonl") {
          here.push_back(entry.path());
        }
      }
    }
    if (here.empty()) {
      throw InputError(folder.string(), "holds no journal of oneac compare",
                       "give the -o folders of the shards");
    }
    std::sort(here.begin(), here.end());
    found.insert(found.end(), here.begin(), here.end());
  }
  return found;
}

Journal::Journal(const fs::path& folder, const CompareSettings& settings, const Shard& shard)
    : path_(journal_path(folder, shard)) {
  const std::string fingerprint = settings.fingerprint();
  if (fs::exists(fs::symlink_status(path_))) {
    content_ = read_journal(path_);
    if (content_.whole_bytes > 0 && content_.settings != fingerprint) {
      throw InputError(
          path_.string(),
          "was begun with other settings: " + difference(content_.settings, fingerprint),
          "repeat them to resume, or choose an empty folder");
    }
    fs::resize_file(path_, content_.whole_bytes);
  }
  file_.reset(std::fopen(path_.c_str(), "ab"));
  if (!file_) throw OutputError(path_.string(), "cannot be opened for writing", "check the folder");
  settings_ = settings;
  if (content_.whole_bytes == 0) write_line(internal::text_of(header(fingerprint, shard)));
  content_.settings = fingerprint;
  content_.shard = shard;
}

bool Journal::has(std::size_t log, std::size_t ordinal) const {
  return std::any_of(content_.pairs.begin(), content_.pairs.end(), [&](const PairRecord& pair) {
    return pair.log == log && pair.ordinal == ordinal;
  });
}

const LogRecord* Journal::log(std::size_t log) const {
  const auto found = std::find_if(content_.logs.begin(), content_.logs.end(),
                                  [&](const LogRecord& record) { return record.log == log; });
  return found == content_.logs.end() ? nullptr : &*found;
}

void Journal::add(const LogRecord& record) {
  write_line(internal::text_of(internal::to_json(record)));
  content_.logs.push_back(record);
}

void Journal::add(const PairRecord& record) {
  const internal::Json json = internal::to_json(record);
  write_line(internal::text_of(json));
  // As it reads back: a resumed comparison gives the same bytes.
  const LogRecord* const told = log(record.log);
  if (told == nullptr) throw std::invalid_argument("PairRecord.log: not added before");
  content_.pairs.push_back(internal::pair_from(json, settings_, *told));
}

void Journal::write_line(const std::string& line) {
  const std::string text = line + "\n";
  const bool written = std::fwrite(text.data(), 1, text.size(), file_.get()) == text.size();
  if (!written || std::fflush(file_.get()) != 0) {
    throw OutputError(path_.string(), "cannot be written to", "free some space and run again");
  }
}

ComparisonData merge_journals(const CompareSettings& settings,
                              const std::vector<JournalContent>& journals) {
  ComparisonData data;
  data.methods = settings.method_labels();
  data.trials = settings.trials;
  for (const JournalContent& journal : journals) {
    if (journal.settings != settings.fingerprint()) {
      throw InputError("--merge",
                       "the journals have different settings: " +
                           difference(settings.fingerprint(), journal.settings),
                       "merge shards of one comparison");
    }
    require_same_logs(journal.logs, data.logs);
    data.pairs.insert(data.pairs.end(), journal.pairs.begin(), journal.pairs.end());
    data.logs.insert(data.logs.end(), journal.logs.begin(), journal.logs.end());
  }
  const auto key = [](const PairRecord& p) { return std::pair(p.log, p.ordinal); };
  std::stable_sort(data.pairs.begin(), data.pairs.end(),
                   [&](const PairRecord& a, const PairRecord& b) { return key(a) < key(b); });
  data.pairs.erase(std::unique(data.pairs.begin(), data.pairs.end(),
                               [&](const auto& a, const auto& b) { return key(a) == key(b); }),
                   data.pairs.end());
  std::stable_sort(data.logs.begin(), data.logs.end(),
                   [](const LogRecord& a, const LogRecord& b) { return a.log < b.log; });
  data.logs.erase(std::unique(data.logs.begin(), data.logs.end(),
                              [](const auto& a, const auto& b) { return a.log == b.log; }),
                  data.logs.end());
  for (const LogRecord& log : data.logs) data.pairs_planned += log.pairs;
  return data;
}

namespace {

std::string shard_text(const Shard& shard) {
  return std::to_string(shard.index) + "/" + std::to_string(shard.count);
}

/// Of every way of dealing that the journals know, the shards without a journal.
void name_absent_shards(const std::vector<JournalContent>& journals,
                        std::vector<std::string>& missing) {
  constexpr std::size_t kMostNamed = 20;
  std::map<std::size_t, std::set<std::size_t>> there;
  for (const JournalContent& journal : journals) {
    there[journal.shard.count].insert(journal.shard.index);
  }
  for (const auto& [count, indices] : there) {
    std::string names;
    std::size_t named = 0;
    for (std::size_t i = 0; i < count && named <= kMostNamed; ++i) {
      if (indices.count(i) > 0) continue;
      const std::string name = named++ < kMostNamed ? shard_text({i, count}) : "…";
      names += (names.empty() ? "" : ", ") + name;
    }
    if (!names.empty()) missing.push_back("no journal of shard " + names);
  }
}

/// Pairs of a log that the shard has to compute, and has not.
std::size_t pairs_to_come(const JournalContent& journal, const LogRecord& log) {
  const Shard& shard = journal.shard;
  const std::size_t mine =
      log.pairs > shard.index ? (log.pairs - shard.index - 1) / shard.count + 1 : 0;
  const auto done = std::count_if(journal.pairs.begin(), journal.pairs.end(),
                                  [&](const PairRecord& pair) { return pair.log == log.log; });
  return mine - std::min(mine, static_cast<std::size_t>(done));
}

}  // namespace

std::vector<std::string> missing_in(const std::vector<JournalContent>& journals,
                                    const ComparisonData& merged) {
  std::vector<std::string> missing;
  const std::size_t logs = settings_of(journals.front()).logs.size();
  if (merged.pairs.size() == merged.pairs_planned && merged.logs.size() == logs) return missing;
  missing.push_back("not complete: " + std::to_string(merged.pairs.size()) + " of " +
                    std::to_string(merged.pairs_planned) + " pairs of " +
                    std::to_string(merged.logs.size()) + " of " + std::to_string(logs) + " logs");
  name_absent_shards(journals, missing);
  for (const JournalContent& journal : journals) {
    for (const LogRecord& log : merged.logs) {
      const std::size_t left = pairs_to_come(journal, log);
      if (left == 0) continue;
      missing.push_back("shard " + shard_text(journal.shard) + " lacks " + std::to_string(left) +
                        " pairs of " + log.name);
    }
  }
  return missing;
}

CompareSettings settings_of(const JournalContent& journal) {
  try {
    return internal::settings_from(Json::parse(journal.settings));
  } catch (const std::exception& error) {
    throw InputError("journal", std::string("its settings cannot be read: ") + error.what(),
                     "use the program that wrote it");
  }
}

}  // namespace oneac
