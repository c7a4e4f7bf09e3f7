#pragma once

#include <cstdio>
#include <exception>

namespace oneac {

/// What `run` of a bench returns; 2, with a line that names the program, when it throws.
inline int guarded(const char* program, int (*run)(int, char**), int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", program, error.what());
    return 2;
  }
}

}  // namespace oneac
