#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace oneac {

/// The images of one instant, either of which may be missing (an empty path).
struct MalagaPair {
  std::string label;
  std::string time_text;  ///< as in the file names
  double time_s = 0.0;
  std::filesystem::path left;
  std::filesystem::path right;
};

/// Pairs up the images img_<label>_<Unix time>_left|right.jpg of an extract, by time: those in
/// Images, else in *_Images, else in the folder itself.
/// @throws InputError naming the folder and what was looked for when there is none
[[nodiscard]] std::vector<MalagaPair> find_malaga_pairs(const std::filesystem::path& source);

}  // namespace oneac
