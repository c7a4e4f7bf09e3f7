#pragma once

#include <functional>
#include <string>

namespace mrpt::obs {
class CObservation;
}

namespace oneac {

/// Writes a rawlog again with each of its observations changed.
void rewrite_log(const std::string& log, const std::string& copy,
                 const std::function<void(mrpt::obs::CObservation&)>& change);

}  // namespace oneac
