#include "quiet_libraries.h"

#include <opencv2/core/utils/logger.hpp>

#ifdef ONEAC_HAS_GLOG
#include <glog/logging.h>
#endif

namespace oneac::app {

void quiet_libraries() {
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
#ifdef ONEAC_HAS_GLOG
  FLAGS_minloglevel = google::GLOG_FATAL;
#endif
}

}  // namespace oneac::app
