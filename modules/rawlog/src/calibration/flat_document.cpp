#include "calibration/flat_document.h"

#include "oneac/base/error.h"
#include "oneac/base/number_text.h"

#include <yaml-cpp/yaml.h>

#include <opencv2/core.hpp>

namespace oneac {
namespace {

constexpr const char* kWriteAgain = "write it again with the tool it comes from";
// Anchors let a few lines nest or repeat without end; a rig of ten cameras has a few hundred.
constexpr std::size_t kDeepest = 8;
constexpr std::size_t kMostWords = 20000;

std::string joined(const std::string& prefix, const std::string& key) {
  return prefix.empty() ? key : prefix + "." + key;
}

class YamlWalk {
 public:
  explicit YamlWalk(FlatDocument& document) : document_(document) {}

  void walk(const YAML::Node& node, const std::string& path, std::size_t depth) {
    if (++words_ > kMostWords || depth > kDeepest) fail(node, "is nested too deep or too long");
    if (node.IsMap()) {
      for (const auto& entry : node) {
        const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "";
        const std::string inner = joined(path, key);
        if (document_.has(inner)) fail(entry.first, "'" + key + "' is there twice");
        walk(entry.second, inner, depth + 1);
      }
    } else if (node.IsSequence()) {
      document_.entries[path];
      for (const auto& element : node) walk_element(element, path, depth);
    } else if (node.IsScalar()) {
      document_.entries[path].push_back(node.Scalar());
    }
  }

 private:
  void walk_element(const YAML::Node& element, const std::string& path, std::size_t depth) {
    if (element.IsMap()) return;  // lists of maps: nothing of a camera
    walk(element, path, depth + 1);
  }

  [[noreturn]] void fail(const YAML::Node& node, const std::string& fault) const {
    throw InputError(document_.file.string() + ": line " + std::to_string(node.Mark().line + 1),
                     fault, kWriteAgain);
  }

  FlatDocument& document_;
  std::size_t words_ = 0;
};

class XmlWalk {
 public:
  explicit XmlWalk(FlatDocument& document) : document_(document) {}

  void walk(const cv::FileNode& node, const std::string& path, std::size_t depth) {
    if (++words_ > kMostWords || depth > kDeepest) {
      throw InputError(document_.file.string(), "is nested too deep or too long", kWriteAgain);
    }
    if (node.isMap()) {
      for (const cv::FileNode& inner : node) walk(inner, joined(path, inner.name()), depth + 1);
    } else if (node.isSeq()) {
      document_.entries[path];
      for (const cv::FileNode& element : node) walk(element, path, depth + 1);
    } else if (node.isInt() || node.isReal()) {
      document_.entries[path].push_back(exact_text(static_cast<double>(node)));
    } else if (node.isString()) {
      document_.entries[path].push_back(static_cast<std::string>(node));
    }
  }

 private:
  FlatDocument& document_;
  std::size_t words_ = 0;
};

/// OpenCV opens with "%YAML:1.0", which is no directive of YAML's; lines keep their numbers.
std::string without_directives(const std::string& text) {
  std::string plain;
  std::size_t at = 0;
  while (at < text.size() && text[at] == '%') {
    const auto end = std::min(text.find('\n', at), text.size());
    plain += '\n';
    at = end + 1;
  }
  return at < text.size() ? plain + text.substr(at) : plain;
}

}  // namespace

std::vector<std::string> FlatDocument::words(const std::string& path) const {
  const auto entry = entries.find(path);
  return entry == entries.end() ? std::vector<std::string>{} : entry->second;
}

std::string FlatDocument::word(const std::string& path) const {
  const auto list = words(path);
  return list.empty() ? "" : list.front();
}

FlatDocument flat_yaml(const std::filesystem::path& file, const std::string& text) {
  FlatDocument document{file, {}};
  try {
    YamlWalk(document).walk(YAML::Load(without_directives(text)), "", 0);
  } catch (const YAML::Exception& error) {
    const std::string line =
        error.mark.is_null() ? "" : ": line " + std::to_string(error.mark.line + 1);
    throw InputError(file.string() + line, "it is no YAML (" + error.msg + ")", kWriteAgain);
  }
  return document;
}

FlatDocument flat_xml(const std::filesystem::path& file, const std::string& text) {
  FlatDocument document{file, {}};
  try {
    const cv::FileStorage storage(
        text, cv::FileStorage::READ | cv::FileStorage::MEMORY | cv::FileStorage::FORMAT_XML);
    if (storage.isOpened()) XmlWalk(document).walk(storage.root(), "", 0);
  } catch (const cv::Exception& error) {
    throw InputError(file.string(), "it is no XML of OpenCV's (" + error.err + ")", kWriteAgain);
  }
  return document;
}

}  // namespace oneac
