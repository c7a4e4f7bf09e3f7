#include <gtest/gtest.h>

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
    {"mrpt_compat", {}},
    {"observations", {"geometry", "base", "mrpt_compat"}},
    {"initialisers", {"robust", "solvers", "geometry", "base", "mrpt_compat"}},
    {"frontend",
     {"initialisers", "features", "refine", "robust", "solvers", "observations", "geometry", "base",
      "mrpt_compat"}},
    {"rawlog", {"observations", "geometry", "base", "mrpt_compat"}},
    {"simulation", {"geometry", "base"}},
    {"evaluation", {"geometry", "base"}},
    {"comparison",
     {"initialisers", "features", "robust", "solvers", "rawlog", "evaluation", "observations",
      "geometry", "report", "base", "mrpt_compat"}},
};

/// Third-party headers that a module's public headers must not show.
const std::vector<std::string> kHidden = {"opencv2/", "vl/",    "ceres/", "nlohmann/",
                                          "zlib.h",   "zstd.h", "CLI/"};
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

TEST(Layers, NoFileGrowsWithoutBound) {
  for (const auto& [module, allowed] : kMayInclude) {
    if (!fs::exists(kModules / module)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(kModules / module)) {
      const std::string extension = entry.path().extension().string();
      const bool test = entry.path().string().find("/tests/") != std::string::npos;
      if (test || (extension != ".h" && extension != ".cpp")) continue;
      std::ifstream in(entry.path());
      int lines = 0;
      for (std::string line; std::getline(in, line);) ++lines;
      EXPECT_LE(lines, extension == ".h" ? 200 : 250) << entry.path();
    }
  }
}

}  // namespace
