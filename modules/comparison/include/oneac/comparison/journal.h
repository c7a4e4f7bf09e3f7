#pragma once

#include "oneac/comparison/pair_record.h"
#include "oneac/comparison/settings.h"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace oneac {

/// What a journal holds.
struct JournalContent {
  std::string settings;  ///< CompareSettings::fingerprint(); "" when the file is new
  Shard shard;
  std::vector<LogRecord> logs;
  std::vector<PairRecord> pairs;
  std::size_t whole_bytes = 0;  ///< up to the end of the last whole line
};

/// Reads a journal, every field checked; a torn last line is left out.
/// @throws InputError for a file that is no journal, naming the line that cannot be
[[nodiscard]] JournalContent read_journal(const std::filesystem::path& path);

/// DIR/journal-<shard>.jsonl
[[nodiscard]] std::filesystem::path journal_path(const std::filesystem::path& folder,
                                                 const Shard& shard);

/// Every journal in the folders, in the order of folders and names. @throws InputError for none
[[nodiscard]] std::vector<std::filesystem::path> find_journals(
    const std::vector<std::filesystem::path>& folders);

/// What was computed so far, a line per pair, on disk before the next pair begins; a comparison
/// that is interrupted goes on from here.
class Journal {
 public:
  /// Opens or begins the journal of the folder; cuts a torn last line off.
  /// @throws InputError when it belongs to other settings, another build of the program or of a
  /// plugin (the first that differs is named), or cannot be read
  Journal(const std::filesystem::path& folder, const CompareSettings& settings, const Shard& shard);

  [[nodiscard]] const JournalContent& content() const { return content_; }
  [[nodiscard]] bool has(std::size_t log, std::size_t ordinal) const;
  [[nodiscard]] const LogRecord* log(std::size_t log) const;

  // Each throws OutputError when the line cannot be written. A pair's log comes before it.
  void add(const LogRecord& record);
  void add(const PairRecord& record);

 private:
  struct CloseFile {
    void operator()(std::FILE* file) const { static_cast<void>(std::fclose(file)); }
  };
  void write_line(const std::string& line);

  std::filesystem::path path_;
  CompareSettings settings_;
  JournalContent content_;
  std::unique_ptr<std::FILE, CloseFile> file_;
};

/// Puts journals of the same settings together, pairs in order, each once.
/// @throws InputError when their settings differ
[[nodiscard]] ComparisonData merge_journals(const CompareSettings& settings,
                                            const std::vector<JournalContent>& journals);

/// What the journals of a comparison lack, a line each: shards of which there is no journal (named
/// as --shard takes them), pairs that a shard has not computed, logs that nobody has begun.
[[nodiscard]] std::vector<std::string> missing_in(const std::vector<JournalContent>& journals,
                                                  const ComparisonData& merged);

/// The settings that a journal was written with. @throws InputError when they cannot be read
[[nodiscard]] CompareSettings settings_of(const JournalContent& journal);

}  // namespace oneac
