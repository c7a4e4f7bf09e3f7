// Closes the loops of a rawlog and prints its keyframes as TUM rows.
//   closed_drive LOG.rawlog CAMERA_HEIGHT
#include <oneac/evaluation/trajectory_io.h>
#include <oneac/frontend/front_end.h>
#include <oneac/frontend/loop_keyframes.h>
#include <oneac/loops/loop_closer.h>
#include <oneac/loops/pose_graph.h>
#include <oneac/rawlog/rawlog_source.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <map>
#include <vector>

namespace {

struct Drive {
  oneac::LoopCamera camera;
  std::vector<oneac::LoopKeyframe> keyframes;
  std::map<std::size_t, oneac::FrameTicket> images;  // by LoopKeyframe::index, read once more
};

Drive drive_through(oneac::RawlogSource& source, const oneac::FrontEndOptions& options) {
  oneac::FrontEnd front_end(options);
  front_end.logging_enable_console_output = false;  // the poses go there
  Drive drive;
  oneac::LoopKeyframes keyframes(options.scale.road_uncertainty);
  while (const auto ticket = source.next()) {
    keyframes.add(front_end.process(front_end.prepare(source.load(*ticket))));
    drive.images.emplace(ticket->index, *ticket);
  }
  keyframes.add(front_end.finish());
  drive.keyframes = keyframes.settled();
  drive.camera.camera = front_end.camera_belief().used;
  drive.camera.R_level_cam = oneac::levelling_rotation(front_end.tilt());
  drive.camera.unused = front_end.car_mask();
  return drive;
}

oneac::ClosedGraph close(const Drive& drive, const oneac::RawlogSource& source) {
  const auto image = [&](std::size_t at) {
    return source.load(drive.images.at(drive.keyframes[at].index)).image;
  };
  oneac::LoopCloser closer({}, drive.camera, image);
  for (std::size_t i = 0; i < drive.keyframes.size(); ++i) {
    closer.add(drive.keyframes[i], closer.features(image(i).view()));
  }
  return oneac::optimise_pose_graph(drive.keyframes, closer.close(2).loops);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return std::fprintf(stderr, "usage: %s LOG HEIGHT\n", argv[0]), 2;
  oneac::FrontEndOptions options;
  options.camera_height = std::atof(argv[2]);
  oneac::SourceOptions log;
  log.log = argv[1];
  try {
    oneac::RawlogSource source(log);
    const Drive drive = drive_through(source, options);
    const oneac::ClosedGraph closed = close(drive, source);
    for (std::size_t i = 0; i < closed.T_first_cam.size(); ++i) {
      const double time = drive.keyframes[i].time_s;
      std::fputs(oneac::tum_line(time, closed.T_first_cam[i]).c_str(), stdout);
    }
    std::fprintf(stderr, "%zu loops\n", closed.loops.size());
  } catch (const std::exception& error) {
    return std::fprintf(stderr, "%s\n", error.what()), 2;
  }
}
