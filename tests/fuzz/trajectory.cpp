// Trajectories in KITTI's and TUM's format; what is accepted survives a round trip.
#include "fuzz.h"

#include "oneac/base/error.h"
#include "oneac/evaluation/trajectory_io.h"

namespace {

using namespace oneac;

template <class Read, class Format>
void read_and_write(std::string_view data, const Read& read, const Format& format) {
  Trajectory trajectory;
  try {
    trajectory = read(fuzz::file_with(data));
  } catch (const InputError&) {  // what it may throw
    return;
  }
  trajectory.validate();
  const Trajectory again = read(fuzz::file_with(format(trajectory)));
  fuzz::check(again.poses.size() == trajectory.poses.size(), "written rows are read again");
  fuzz::check(again.times == trajectory.times, "times keep every digit");
}

}  // namespace

ONEAC_FUZZ_TARGET(trajectory) {
  read_and_write(data, read_kitti, format_kitti);
  read_and_write(data, read_tum, format_tum);
  try {
    static_cast<void>(read_trajectory(fuzz::file_with(data)));
  } catch (const InputError&) {  // what it may throw
  }
}
