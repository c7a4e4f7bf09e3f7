#pragma once

#include <filesystem>
#include <vector>

namespace oneac::test {

/// A video of MPEG-4 with two B-frames between others, 64x48, whose frames have these times [ms];
/// frame i is a texture that moves, the same at each call. The file's ending tells its
/// kind; an AVI has ten frames a second.
void write_video(const std::filesystem::path& file, const std::vector<int>& times_ms);

}  // namespace oneac::test
