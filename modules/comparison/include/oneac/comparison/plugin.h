#pragma once

#include <filesystem>
#include <string>

namespace oneac {

/// Loads a library whose initialisers register themselves with MRPT's class factory, for the life
/// of the program. @throws InputError when it cannot be loaded or brings no initialiser
void load_plugin(const std::filesystem::path& library);

/// The library of a name: beside the running program, or in ../lib/oneac from there.
/// @throws InputError when it is in neither place
[[nodiscard]] std::filesystem::path find_plugin(const std::string& name);

}  // namespace oneac
