#pragma once

#include "oneac/base/error.h"

#include <string>
#include <string_view>
#include <utility>

namespace oneac::python {

/// Who is asked: the library's messages advise flags of the command, which are arguments here.
enum class Asked { kRawlog, kFrontEnd };

/// A message with the flags in it named as the arguments of Rawlog or FrontEnd; "--every 0" becomes
/// "every=0".
[[nodiscard]] std::string in_python(std::string_view message, Asked asked);

/// Throws oneac.InputError with this message. @pre the interpreter's lock is held
[[noreturn]] void throw_input_error(const std::string& message);

/// What `work` gives; its InputErrors are told in Python's words. `work` may release the
/// interpreter's lock.
template <class Work>
decltype(auto) told_in_python(Asked asked, Work&& work) {
  try {
    return std::forward<Work>(work)();
  } catch (const InputError& error) {
    throw_input_error(in_python(error.what(), asked));
  }
}

}  // namespace oneac::python
