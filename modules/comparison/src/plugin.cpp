#include "oneac/comparison/plugin.h"

#include "oneac/base/error.h"
#include "oneac/base/input_file.h"
#include "oneac/base/printable.h"
#include "oneac/initialisers/checked_answer.h"
#include "oneac/initialisers/plugin_stamp.h"

#include <dlfcn.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

namespace oneac {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestName = 60;  // [byte] of a stranger's word in a message
constexpr const char* kRebuild =
    "build it with oneac_plugin() against this oneac, with the compiler and flags of this oneac";

/// The stamps of all files that the library was made of.
std::vector<PluginStamp> stamps_in(const fs::path& library, const PluginStamp& ours) {
  std::ifstream in(library, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  const std::string_view mark(ours.begin.data(), ours.begin.size());
  std::vector<PluginStamp> stamps;
  for (auto at = bytes.find(mark); at != std::string::npos; at = bytes.find(mark, at + 1)) {
    if (bytes.size() - at < sizeof(PluginStamp)) break;
    PluginStamp stamp;
    std::memcpy(&stamp, bytes.data() + at, sizeof stamp);
    if (stamp.end == ours.end) stamps.push_back(stamp);  // else a copy of the mark alone
  }
  return stamps;
}

std::string text_of(const std::array<char, 24>& letters) {
  return {letters.data(), ::strnlen(letters.data(), letters.size())};
}

/// "" where the two agree.
std::string difference(const PluginStamp& theirs, const PluginStamp& ours) {
  if (theirs.version != ours.version) {
    return "was built for oneac " + text_of(theirs.version) + ", this is " + text_of(ours.version);
  }
  // The flags come last and are told first: sizes differ because of them.
  for (std::size_t i = PluginStamp::kFields; i-- > 0;) {
    if (theirs.fields[i] == ours.fields[i]) continue;
    return std::string("was built with another ") + kPluginStampFields[i] + ": " +
           std::to_string(theirs.fields[i]) + ", this program has " +
           std::to_string(ours.fields[i]);
  }
  return "";
}

/// Before any code of the library runs: calling one that was built otherwise ends in a crash.
void require_same_build(const fs::path& library) {
  static constexpr PluginStamp kOurs = plugin_stamp(ONEAC_RELEASE);
  const auto stamps = stamps_in(library, kOurs);
  if (stamps.empty()) {
    throw InputError(library.string(), "does not say which oneac it was built for", kRebuild);
  }
  for (const PluginStamp& stamp : stamps) {
    const std::string fault = difference(stamp, kOurs);
    if (!fault.empty()) throw InputError(library.string(), fault, kRebuild);
  }
}

/// @param before  sorted, of those that were there
void require_new_names(const fs::path& library, const std::vector<std::string>& before) {
  constexpr const char* kSee = "see docs/my-own-initialiser.md";
  std::vector<std::string> names;
  try {
    names = initialiser_names();
  } catch (const std::exception& error) {
    throw InputError(library.string(), "name() of its initialiser threw: " + told(error), kSee);
  } catch (...) {
    throw InputError(library.string(), "name() of its initialiser threw", kSee);
  }
  if (names.size() == before.size()) {
    throw InputError(library.string(), "registers no initialiser of a new name", kSee);
  }
  for (const std::string& name : names) {
    if (name.empty() || printable(name) != name || name.find_first_of(", +") != std::string::npos) {
      throw InputError(library.string(),
                       "calls an initialiser '" + shortened(printable(name), kLongestName) +
                           "', must be a word without comma, blank or +",
                       kSee);
    }
  }
  const auto twice = std::adjacent_find(names.begin(), names.end());
  if (twice != names.end()) {
    throw InputError(library.string(),
                     "registers an initialiser called " + *twice + ", and there is one already",
                     "give it a name of its own");
  }
}

}  // namespace

void load_plugin(const fs::path& library) {
  if (const std::string fault = fault_of_file(library); !fault.empty()) {
    throw InputError(library.string(), fault == "no such file" ? "no such plugin library" : fault,
                     "check the path after --plugin");
  }
  require_same_build(library);
  const std::vector<std::string> before = initialiser_names();
  // An absolute path keeps dlopen from searching the system's folders. Never closed: MRPT's class
  // factory keeps pointers into it.
  if (::dlopen(fs::absolute(library).c_str(), RTLD_NOW | RTLD_LOCAL) == nullptr) {
    throw InputError(library.string(), "cannot be loaded (" + std::string(::dlerror()) + ")",
                     "build it against this version of oneac");
  }
  require_new_names(library, before);
}

fs::path find_plugin(const std::string& name) {
  if (fs::path library = file_of_program(name + ".so"); !library.empty()) return library;
  throw InputError(name + ".so", "is not beside the program nor in ../lib/oneac",
                   "build oneac with OpenCV and OpenGV, target " + name);
}

}  // namespace oneac
