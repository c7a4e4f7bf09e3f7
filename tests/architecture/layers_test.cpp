#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
const fs::path kModules = fs::path(ONEAC_SOURCE_DIR) / "modules";
const fs::path kPython = fs::path(ONEAC_SOURCE_DIR) / "python" / "src";

/// What each module may include, itself left out; the arrows of docs/architecture.md.
const std::map<std::string, std::set<std::string>> kMayInclude = {
    {"base", {}},
    {"report", {"base"}},
    {"geometry", {"base"}},
    {"solvers", {"geometry", "base"}},
    {"study", {"solvers", "geometry", "report", "base"}},
    {"robust", {"solvers", "geometry", "base"}},
    {"features", {"geometry", "base"}},
    {"refine", {"geometry", "base"}},
    {"calibration", {"geometry", "base"}},
    {"loops", {"features", "refine", "robust", "solvers", "geometry", "base"}},
    {"mrpt_compat", {}},
    {"observations", {"geometry", "base", "mrpt_compat"}},
    {"initialisers", {"robust", "solvers", "geometry", "base", "mrpt_compat"}},
    {"frontend",
     {"initialisers", "loops", "features", "refine", "calibration", "robust", "solvers",
      "observations", "geometry", "base", "mrpt_compat"}},
    {"rawlog", {"observations", "geometry", "base", "mrpt_compat"}},
    {"simulation", {"geometry", "base"}},
    {"evaluation", {"geometry", "base"}},
    {"comparison",
     {"initialisers", "features", "robust", "solvers", "rawlog", "evaluation", "observations",
      "geometry", "report", "base", "mrpt_compat"}},
};

/// Third-party headers that a module's public headers must not show.
const std::vector<std::string> kHidden = {"opencv2/", "vl/",    "ceres/", "nlohmann/",
                                          "zlib.h",   "zstd.h", "CLI/",   "pybind11/"};
/// MRPT is at home in these modules only.
const std::set<std::string> kKnowMrpt = {"mrpt_compat", "observations", "initialisers",
                                         "frontend",    "rawlog",       "comparison"};

struct Include {
  fs::path file;
  std::string header;
};

std::vector<Include> includes_under(const fs::path& folder) {
  static const std::regex kInclude(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
  std::vector<Include> includes;
  if (!fs::exists(folder)) return includes;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".h" && extension != ".cpp") continue;
    std::ifstream in(entry.path());
    for (std::string line; std::getline(in, line);) {
      std::smatch match;
      if (std::regex_search(line, match, kInclude)) includes.push_back({entry.path(), match[1]});
    }
  }
  return includes;
}

bool starts_with(const std::string& text, const std::string& prefix) {
  return text.rfind(prefix, 0) == 0;
}

TEST(Layers, EveryModuleHasItsPlace) {
  for (const auto& entry : fs::directory_iterator(kModules)) {
    EXPECT_EQ(kMayInclude.count(entry.path().filename().string()), 1U) << entry.path();
  }
}

TEST(Layers, NoIncludeClimbs) {
  std::size_t seen = 0;
  for (const auto& [module, allowed] : kMayInclude) {
    for (const char* part : {"include", "src"}) {
      for (const Include& include : includes_under(kModules / module / part)) {
        if (!starts_with(include.header, "oneac/")) continue;
        const std::string rest = include.header.substr(6);
        const std::string used = rest.substr(0, rest.find('/'));
        EXPECT_TRUE(used == module || allowed.count(used) == 1)
            << include.file << " includes " << include.header;
        ++seen;
      }
    }
  }
  EXPECT_GT(seen, 100U);  // the scan found something
}

TEST(Layers, PublicHeadersHideThirdParties) {
  for (const auto& [module, allowed] : kMayInclude) {
    if (module == "mrpt_compat") continue;  // not public: only sources of other modules include it
    for (const Include& include : includes_under(kModules / module / "include")) {
      for (const std::string& hidden : kHidden) {
        EXPECT_FALSE(starts_with(include.header, hidden))
            << include.file << " shows " << include.header;
      }
    }
  }
}

TEST(Layers, MrptStaysInItsModules) {
  for (const auto& [module, allowed] : kMayInclude) {
    if (kKnowMrpt.count(module) == 1) continue;
    for (const char* part : {"include", "src"}) {
      for (const Include& include : includes_under(kModules / module / part)) {
        EXPECT_FALSE(starts_with(include.header, "mrpt/")) << include.file;
      }
    }
  }
}

/// Lengths of the functions of a file as clang-format lays them out: from a line that begins in
/// this column to the brace that stands alone in it, unless it begins a block of statements.
std::vector<int> function_lengths(const fs::path& file, std::size_t column) {
  std::vector<int> lengths;
  const std::string end = std::string(column, ' ') + "}";
  const std::regex block(R"(^ *(if|for|while|switch|do|try)\b.*|^ *\{$)");
  std::ifstream in(file);
  int number = 0, begin = 0;
  bool is_function = false;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (line == end) {
      if (is_function) lengths.push_back(number - begin + 1);
    } else if (line.find_first_not_of(' ') == column && line[column] != '}' &&
               line[column] != '/' && line[column] != '#' && line[column] != ':') {
      begin = number;
      is_function = !std::regex_match(line, block);
    }
  }
  return lengths;
}

TEST(Layers, FunctionsStayShort) {
  std::vector<int> lengths;
  for (const fs::path& folder : {kModules, kPython}) {
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      const std::string extension = entry.path().extension().string();
      const bool test = entry.path().string().find("/tests/") != std::string::npos;
      if (test || (extension != ".h" && extension != ".cpp")) continue;
      for (const std::size_t column : {std::size_t{0}, std::size_t{2}}) {
        for (const int lines : function_lengths(entry.path(), column)) {
          EXPECT_LE(lines, 60) << entry.path();
          lengths.push_back(lines);
        }
      }
    }
  }
  ASSERT_GT(lengths.size(), 1000U);
  const auto at = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() * 95 / 100);
  std::nth_element(lengths.begin(), at, lengths.end());
  EXPECT_LE(*at, 25) << "95 % of the functions";
}

}  // namespace
