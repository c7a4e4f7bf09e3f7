#include "oneac/comparison/plugin.h"

#include "oneac/base/error.h"
#include "oneac/base/input_file.h"
#include "oneac/initialisers/plugin_stamp.h"

#include <dlfcn.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

namespace oneac {
namespace {

namespace fs = std::filesystem;

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

}  // namespace

void load_plugin(const fs::path& library) {
  if (const std::string fault = fault_of_file(library); !fault.empty()) {
    throw InputError(library.string(), fault == "no such file" ? "no such plugin library" : fault,
                     "check the path after --plugin");
  }
  require_same_build(library);
  const std::size_t before = initialiser_names().size();
  // An absolute path keeps dlopen from searching the system's folders. Never closed: MRPT's class
  // factory keeps pointers into it.
  if (::dlopen(fs::absolute(library).c_str(), RTLD_NOW | RTLD_LOCAL) == nullptr) {
    throw InputError(library.string(), "cannot be loaded (" + std::string(::dlerror()) + ")",
                     "build it against this version of oneac");
  }
  if (initialiser_names().size() == before) {
    throw InputError(library.string(), "registers no initialiser of a new name",
                     "see docs/my-own-initialiser.md");
  }
}

fs::path find_plugin(const std::string& name) {
  if (fs::path library = file_of_program(name + ".so"); !library.empty()) return library;
  throw InputError(name + ".so", "is not beside the program nor in ../lib/oneac",
                   "build oneac with OpenCV and OpenGV, target " + name);
}

}  // namespace oneac
