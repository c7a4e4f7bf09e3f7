#pragma once

#include <string>
#include <vector>

namespace oneac {

/// The candidate with the smallest edit distance to a mistyped name; the first of equals; "" when
/// there are none. For messages such as "unknown key 'treshold_px', did you mean 'threshold_px'?".
[[nodiscard]] std::string nearest_name(const std::string& name,
                                       const std::vector<std::string>& candidates);

}  // namespace oneac
