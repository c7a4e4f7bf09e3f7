#pragma once

#include "oneac/rawlog/sensor_records.h"

#include <cstddef>
#include <vector>

namespace oneac {

/// Height of a fix that none was told of.
[[nodiscard]] double unknown_height();

/// Brings a receiver's fixes into the order of time: those of a file that goes backwards are turned
/// about; left out are those at 0, 0, a few whose date is not that of the others (receivers whose
/// weeks ran over, or before their first almanac), and what is not later than all before.
/// @return how many were left out
[[nodiscard]] std::size_t put_in_order(std::vector<GpsRecord>& fixes);

/// Heights that none was told of lie between those around them, and are 0 where none is known at
/// all.
void fill_heights(std::vector<GpsRecord>& fixes);

}  // namespace oneac
