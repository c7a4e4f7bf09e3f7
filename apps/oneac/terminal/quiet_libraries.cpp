#include "quiet_libraries.h"

#ifdef ONEAC_HAS_GLOG
#include <glog/logging.h>
#endif

namespace oneac::app {

void quiet_libraries() {
#ifdef ONEAC_HAS_GLOG
  FLAGS_minloglevel = google::GLOG_FATAL;
#endif
}

}  // namespace oneac::app
