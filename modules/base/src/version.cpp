#include "oneac/base/version.h"

#ifndef ONEAC_VERSION
#define ONEAC_VERSION "0.0.0"
#endif
#ifndef ONEAC_COMMIT
#define ONEAC_COMMIT "unknown"
#endif

namespace oneac {

std::string version() {
  return std::string(ONEAC_VERSION) + " (" + ONEAC_COMMIT + ")";
}

}  // namespace oneac
