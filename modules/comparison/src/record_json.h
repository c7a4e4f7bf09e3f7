#pragma once

#include "oneac/comparison/pair_record.h"
#include "oneac/comparison/settings.h"

#include <nlohmann/json.hpp>

namespace oneac::internal {

using Json = nlohmann::ordered_json;

[[nodiscard]] Json to_json(const CompareSettings& settings);
[[nodiscard]] Json to_json(const LogRecord& record);
[[nodiscard]] Json to_json(const PairRecord& record);

// Each throws nlohmann's exceptions for what is not as to_json writes it.
[[nodiscard]] CompareSettings settings_from(const Json& json);
[[nodiscard]] LogRecord log_from(const Json& json);
[[nodiscard]] PairRecord pair_from(const Json& json);

}  // namespace oneac::internal
