#include "oneac/rawlog/log_neighbours.h"

#include <algorithm>
#include <system_error>

namespace oneac {
namespace {

namespace fs = std::filesystem;

void add_bases(const fs::path& log, std::vector<fs::path>& bases) {
  const fs::path folder = log.has_parent_path() ? log.parent_path() : fs::path(".");
  std::vector<fs::path> names{log.stem()};
  const std::string packing = log.extension().string();
  if (packing == ".gz" || packing == ".zst") names.push_back(log.stem().stem());
  for (const fs::path& name : names) {
    const fs::path base = folder / name;
    if (std::find(bases.begin(), bases.end(), base) == bases.end()) bases.push_back(base);
  }
}

}  // namespace

std::vector<fs::path> bases_beside(const fs::path& log) {
  std::vector<fs::path> bases;
  add_bases(log, bases);
  std::error_code error;
  if (!fs::is_symlink(fs::symlink_status(log, error))) return bases;
  const fs::path target = fs::canonical(log, error);
  if (!error) add_bases(target, bases);
  return bases;
}

std::string poses_beside(const fs::path& log) {
  std::error_code ignored;
  const std::vector<fs::path> bases = bases_beside(log);
  for (const fs::path& base : bases) {
    const fs::path named = base.string() + "_poses.txt";
    if (fs::is_regular_file(named, ignored)) return named.string();
  }
  for (const fs::path& base : bases) {
    const fs::path plain = base.parent_path() / "poses.txt";
    if (fs::is_regular_file(plain, ignored)) return plain.string();
  }
  return "";
}

}  // namespace oneac
