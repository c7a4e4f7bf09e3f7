#include "oneac/comparison/plugin.h"

#include "oneac/base/error.h"
#include "oneac/initialisers/relative_pose_initialiser.h"

#include <dlfcn.h>

namespace oneac {
namespace fs = std::filesystem;

void load_plugin(const fs::path& library) {
  if (!fs::is_regular_file(library)) {
    throw InputError(library.string(), "no such plugin library", "check the path after --plugin");
  }
  const std::size_t before = initialiser_names().size();
  // An absolute path keeps dlopen from searching the system's folders. Never closed: MRPT's class
  // factory keeps pointers into it.
  if (::dlopen(fs::absolute(library).c_str(), RTLD_NOW | RTLD_LOCAL) == nullptr) {
    std::string reason = ::dlerror();
    for (char& letter : reason) letter = letter == '\n' ? ' ' : letter;
    throw InputError(library.string(), "cannot be loaded (" + reason + ")",
                     "build it against this version of oneac");
  }
  if (initialiser_names().size() == before) {
    throw InputError(library.string(), "registers no initialiser of a new name",
                     "see docs/my-own-initialiser.md");
  }
}

fs::path find_plugin(const std::string& name) {
  const fs::path beside = fs::read_symlink("/proc/self/exe").parent_path();
  for (const fs::path& folder : {beside, beside.parent_path() / "lib" / "oneac"}) {
    fs::path candidate = folder / (name + ".so");
    if (fs::is_regular_file(candidate)) return candidate;
  }
  throw InputError(name + ".so", "is not beside the program nor in ../lib/oneac",
                   "build oneac with OpenCV and OpenGV, target " + name);
}

}  // namespace oneac
