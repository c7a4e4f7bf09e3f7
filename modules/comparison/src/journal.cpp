#include "oneac/comparison/journal.h"

#include "record_json.h"

#include "oneac/base/atomic_file.h"
#include "oneac/base/error.h"

#include <algorithm>
#include <fstream>
#include <iterator>

namespace oneac {
namespace {

namespace fs = std::filesystem;
using internal::Json;

constexpr const char* kMark = "oneac_compare";
constexpr int kVersion = 1;

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

void take_line(const std::string& line, const fs::path& path, JournalContent& content) {
  try {
    const Json json = Json::parse(line);
    if (json.contains(kMark)) {
      if (json.at(kMark).get<int>() != kVersion) no_journal(path);
      content.settings = json.at("settings").dump();
      content.shard = {json.at("shard").at(0).get<std::size_t>(),
                       json.at("shard").at(1).get<std::size_t>()};
    } else if (json.contains("name")) {
      content.logs.push_back(internal::log_from(json));
    } else {
      content.pairs.push_back(internal::pair_from(json));
    }
  } catch (const Json::exception&) {
    no_journal(path);
  }
}

/// The first key in which two fingerprints differ, with both values.
std::string difference(const std::string& before, const std::string& now) {
  const Json a = Json::parse(before);
  const Json b = Json::parse(now);
  for (const auto& [key, value] : b.items()) {
    const Json old = a.contains(key) ? a.at(key) : Json();
    if (old != value) return key + " was " + old.dump() + " and is now " + value.dump();
  }
  return "the settings differ";
}

}  // namespace

JournalContent read_journal(const fs::path& path) {
  JournalContent content;
  std::ifstream in(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  std::size_t begin = 0;
  for (std::size_t end = 0; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1) {
    take_line(text.substr(begin, end - begin), path, content);
  }
  content.whole_bytes = begin;
  if (begin > 0 && content.settings.empty()) no_journal(path);
  return content;
}

fs::path journal_path(const fs::path& folder, const Shard& shard) {
  return folder / ("journal-" + shard.name() + ".jsonl");
}

std::vector<fs::path> find_journals(const std::vector<fs::path>& folders) {
  std::vector<fs::path> found;
  for (const fs::path& folder : folders) {
    std::vector<fs::path> here;
    if (fs::is_directory(folder)) {
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
  if (fs::exists(path_)) {
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
  if (content_.whole_bytes == 0) write_line(header(fingerprint, shard).dump());
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
  write_line(internal::to_json(record).dump());
  content_.logs.push_back(record);
}

void Journal::add(const PairRecord& record) {
  write_line(internal::to_json(record).dump());
  // As it reads back: a resumed comparison gives the same bytes.
  content_.pairs.push_back(internal::pair_from(internal::to_json(record)));
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

CompareSettings settings_of(const JournalContent& journal) {
  try {
    return internal::settings_from(Json::parse(journal.settings));
  } catch (const std::exception& error) {
    throw InputError("journal", std::string("its settings cannot be read: ") + error.what(),
                     "use the program that wrote it");
  }
}

}  // namespace oneac
