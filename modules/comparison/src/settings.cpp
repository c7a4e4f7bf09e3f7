#include "oneac/comparison/settings.h"

#include "record_json.h"

#include "oneac/base/error.h"
#include "oneac/base/input_file.h"
#include "oneac/base/parameter_table.h"
#include "oneac/base/printable.h"
#include "oneac/base/version.h"

#include <algorithm>
#include <charconv>
#include <filesystem>

namespace oneac {
namespace {

bool read_number(const std::string& text, std::size_t& number) {
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && stop == end;
}

}  // namespace

std::string running_program() {
  return version() + ", build " + content_hash("/proc/self/exe");
}

std::string identity_of_plugin(const std::filesystem::path& library) {
  return library.filename().string() + " " + content_hash(library);
}

std::string Shard::name() const {
  return std::to_string(index) + "of" + std::to_string(count);
}

Shard parse_shard(const std::string& text) {
  const auto slash = text.find('/');
  Shard shard;
  const bool good = slash != std::string::npos && read_number(text.substr(0, slash), shard.index) &&
                    read_number(text.substr(slash + 1), shard.count) && shard.index < shard.count;
  if (!good) {
    throw InputError("--shard " + text, "is not i/n with i from 0 to n - 1",
                     "write 0/4, 1/4, 2/4, 3/4 for four shards");
  }
  return shard;
}

SourceOptions CompareSettings::source_of(std::size_t log) const {
  SourceOptions options = source;
  options.log = logs.at(log);
  return options;
}

std::vector<std::string> CompareSettings::log_names() const {
  std::vector<std::string> names;
  for (const std::string& log : logs) {
    std::filesystem::path stem = std::filesystem::path(log).filename();
    while (stem.has_extension() && stem != stem.stem()) stem = stem.stem();
    std::string name = printable(stem.string());
    for (char& letter : name) {
      const bool plain = static_cast<unsigned char>(letter) > ' ' && letter != ',' && letter != '"';
      if (!plain) letter = '_';
    }
    std::string unique = name;
    for (int copy = 2; std::count(names.begin(), names.end(), unique) > 0; ++copy) {
      unique = name + "-" + std::to_string(copy);
    }
    names.push_back(unique);
  }
  return names;
}

std::vector<std::string> CompareSettings::method_labels() const {
  std::vector<std::string> labels;
  for (const CompareMethod& method : methods) labels.push_back(method.label);
  return labels;
}

std::string CompareSettings::fingerprint() const {
  return internal::text_of(internal::to_json(*this));
}

void CompareSettings::validate() const {
  if (logs.empty()) throw InputError("compare", "no rawlog given", "oneac compare LOG... -o DIR");
  if (trials < 1) {
    throw InputError("--trials " + std::to_string(trials), "must be at least 1", "leave it out");
  }
  if (!reference.empty() && logs.size() > 1) {
    throw InputError("--reference " + reference, "one file of poses cannot serve several logs",
                     "put <log base>_poses.txt beside each log, or compare them one by one and "
                     "leave --reference out");
  }
  source_of(0).validate();
}

}  // namespace oneac
