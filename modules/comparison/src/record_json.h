#pragma once

#include "oneac/comparison/pair_record.h"
#include "oneac/comparison/settings.h"

#include <nlohmann/json.hpp>

#include <string>

namespace oneac::internal {

using Json = nlohmann::ordered_json;

/// One line; whatever is no UTF-8 in it is replaced.
[[nodiscard]] std::string text_of(const Json& json);

[[nodiscard]] Json to_json(const CompareSettings& settings);
[[nodiscard]] Json to_json(const LogRecord& record);
[[nodiscard]] Json to_json(const PairRecord& record);

// What to_json wrote, every field checked: each throws nlohmann's exceptions for another form and
// std::invalid_argument naming field, value and bound.
[[nodiscard]] CompareSettings settings_from(const Json& json);
/// @param settings  of the journal
[[nodiscard]] LogRecord log_from(const Json& json, const CompareSettings& settings);
/// @param log  the pair's
[[nodiscard]] PairRecord pair_from(const Json& json, const CompareSettings& settings,
                                   const LogRecord& log);
/// Number of the log that a pair belongs to.
[[nodiscard]] std::size_t log_of_pair(const Json& json, const CompareSettings& settings);

}  // namespace oneac::internal
