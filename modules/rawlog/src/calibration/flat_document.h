#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace oneac {

/// A YAML or XML document as lists of words under paths such as "cam0.intrinsics"; a single value
/// is a list of one, the rows of a matrix follow each other.
struct FlatDocument {
  std::filesystem::path file;
  std::map<std::string, std::vector<std::string>> entries;

  [[nodiscard]] bool has(const std::string& path) const { return entries.count(path) != 0; }
  /// Empty when there is no such path.
  [[nodiscard]] std::vector<std::string> words(const std::string& path) const;
  /// The first word; empty when there is no such path.
  [[nodiscard]] std::string word(const std::string& path) const;
};

/// @throws InputError naming the line where the text is no YAML, a key is there twice, or it is
///         nested beyond what a calibration needs
[[nodiscard]] FlatDocument flat_yaml(const std::filesystem::path& file, const std::string& text);

/// A document of OpenCV's FileStorage. @throws InputError when it is none
[[nodiscard]] FlatDocument flat_xml(const std::filesystem::path& file, const std::string& text);

}  // namespace oneac
