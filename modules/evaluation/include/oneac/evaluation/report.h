#pragma once

#include "oneac/evaluation/evaluate.h"

#include <string>

namespace oneac {

/// Plain aligned table for a terminal, angles in degrees, lines end with \n.
/// @param each_pair  one line per pair before the summary
[[nodiscard]] std::string format_table(const Evaluation& evaluation, bool each_pair);

/// The same as a JSON object; keys carry the unit, what is not defined is null.
/// @param each_pair  with an array "pairs" of one object per pair
[[nodiscard]] std::string format_json(const Evaluation& evaluation, bool each_pair);

}  // namespace oneac
