#include "oneac/initialisers/relative_pose_initialiser.h"

#include "method_initialiser.h"

#include "oneac/base/error.h"
#include "oneac/base/nearest_name.h"

#include <algorithm>

IMPLEMENTS_VIRTUAL_MRPT_OBJECT(RelativePoseInitialiser, mrpt::rtti::CObject, oneac)

namespace oneac {
namespace {

/// Once, whatever the linker dropped of a static library.
void register_built_in() {
  static const bool registered = [] {
    register_methods();
    return true;
  }();
  static_cast<void>(registered);
}

/// One object of every registered class that can be made.
std::vector<RelativePoseInitialiser::Ptr> make_all() {
  register_built_in();
  std::vector<RelativePoseInitialiser::Ptr> all;
  for (const auto* id :
       mrpt::rtti::getAllRegisteredClassesChildrenOf(CLASS_ID(RelativePoseInitialiser))) {
    if (id->ptrCreateObject == nullptr) continue;  // abstract
    auto object = std::dynamic_pointer_cast<RelativePoseInitialiser>(id->createObject());
    if (object) all.push_back(object);
  }
  return all;
}

}  // namespace

std::vector<std::string> initialiser_names() {
  std::vector<std::string> names;
  for (const auto& initialiser : make_all()) names.push_back(initialiser->name());
  std::sort(names.begin(), names.end());
  return names;
}

RelativePoseInitialiser::Ptr make_initialiser(const std::string& name) {
  for (const auto& initialiser : make_all()) {
    if (initialiser->name() == name) return initialiser;
    if (name == initialiser->GetRuntimeClass()->className) return initialiser;
  }
  const std::vector<std::string> names = initialiser_names();
  std::string list;
  for (const std::string& known : names) list += (list.empty() ? "" : ", ") + known;
  throw InputError("initialiser '" + name + "'",
                   "no such method, did you mean '" + nearest_name(name, names) + "'?",
                   "choose one of: " + list);
}

}  // namespace oneac
