#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace oneac {

/// Where the files that belong to a log may be, DIR/BASE without an ending: BASE is the log's name
/// without its last ending and, of drive.rawlog.gz, also "drive"; DIR its folder and, of a link,
/// the folder of the log that it leads to.
[[nodiscard]] std::vector<std::filesystem::path> bases_beside(const std::filesystem::path& log);

/// BASE_poses.txt or poses.txt beside a log (see bases_beside); "" when there is neither.
[[nodiscard]] std::string poses_beside(const std::filesystem::path& log);

}  // namespace oneac
