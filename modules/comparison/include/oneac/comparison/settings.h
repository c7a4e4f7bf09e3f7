#pragma once

#include "oneac/comparison/given_tilt.h"
#include "oneac/comparison/method.h"
#include "oneac/features/feature_options.h"
#include "oneac/rawlog/rawlog_source.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace oneac {

/// Which part of the pairs: those whose number modulo `count` is `index`.
struct Shard {
  std::size_t index = 0;
  std::size_t count = 1;

  /// Whether the pair of this number is in the share.
  [[nodiscard]] bool has(std::size_t ordinal) const { return ordinal % count == index; }
  /// "0of1", the part of the journal's name.
  [[nodiscard]] std::string name() const;
};

/// Reads "i/n", 0 ≤ i < n. @throws InputError naming the text
[[nodiscard]] Shard parse_shard(const std::string& text);

/// "0.1.0 (abc123456), build 89ab…": version of the running program and a hash of its file.
[[nodiscard]] std::string running_program();
/// "name.so 89ab…": a library and a hash of its file.
[[nodiscard]] std::string identity_of_plugin(const std::filesystem::path& library);

/// Everything that the results of a comparison depend on.
struct CompareSettings {
  std::vector<std::string> logs;
  SourceOptions source;  ///< `log` is not used
  FeatureOptions features;
  GivenTilt tilt;
  std::string reference;  ///< poses of the only log; "": beside each log, else its GPS
  std::vector<CompareMethod> methods;
  std::string method_parameters;  ///< YAML, see make_method
  int trials = 1;                 ///< per pair and method; trial k has the seed `seed` + k
  std::uint64_t seed = 0;
  std::string program;               ///< what computes: version and hash of the program's file
  std::vector<std::string> plugins;  ///< name and hash of each library with methods

  /// One log's source. @pre log < logs.size()
  [[nodiscard]] SourceOptions source_of(std::size_t log) const;
  /// Short name of each log for tables, without comma, each different.
  [[nodiscard]] std::vector<std::string> log_names() const;
  /// Of the methods, in the order of the tables.
  [[nodiscard]] std::vector<std::string> method_labels() const;
  /// All of the above as one line of JSON; equal text means equal results.
  [[nodiscard]] std::string fingerprint() const;
  /// @throws InputError naming field, value and bound
  void validate() const;
};

}  // namespace oneac
