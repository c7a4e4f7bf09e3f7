#pragma once

#include <string>

namespace oneac::app {

/// A parameter that the command line sets: by --set, or by a flag that is also a key.
struct Setting {
  std::string typed;  ///< what messages call it: "--set run.threads", "--threads"
  std::string key;
  std::string value;
};

}  // namespace oneac::app
