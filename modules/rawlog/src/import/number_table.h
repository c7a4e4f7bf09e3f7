#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace oneac {

/// Rows of numbers out of a text file, separated by blanks. Empty lines and lines that start with
/// '%' or '#' are skipped.
/// @param least_columns  fewer in a row is an error
/// @throws InputError naming file and line when it cannot be read, a row is short, or a word is not
///         a finite number
[[nodiscard]] std::vector<std::vector<double>> read_number_table(const std::filesystem::path& file,
                                                                 std::size_t least_columns);

}  // namespace oneac
