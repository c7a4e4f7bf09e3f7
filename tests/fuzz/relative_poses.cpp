// relative_poses.csv; what is accepted survives a round trip.
#include "fuzz.h"

#include "oneac/base/error.h"
#include "oneac/evaluation/relative_poses_io.h"

ONEAC_FUZZ_TARGET(relative_poses) {
  using namespace oneac;
  static_cast<void>(looks_like_relative_poses(fuzz::file_with(data)));
  std::vector<RelativePoseRow> rows;
  try {
    rows = read_relative_poses(fuzz::file_with(data));
  } catch (const InputError&) {  // what it may throw
    return;
  }
  for (const RelativePoseRow& row : rows) fuzz::check(row.T_2_1.is_finite(), "finite poses");
  const std::string text = format_relative_poses(rows);
  fuzz::check(read_relative_poses(fuzz::file_with(text)).size() == rows.size(),
              "written rows are read again");
}
