// Feeds a rawlog to oneac::FrontEnd and prints the camera's final poses as TUM rows.
//   consumer LOG.rawlog IMAGES_DIR [CAMERA_HEIGHT]
#include <oneac/frontend/front_end.h>

#include <mrpt/img/CImage.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/serialization/CArchive.h>

#include <Eigen/Geometry>

#include <cstdio>
#include <cstdlib>
#include <exception>

namespace {

void print_pose(const oneac::FramePose& pose) {
  const Eigen::Quaterniond q(pose.T_first_cam.linear());
  const Eigen::Vector3d p = pose.T_first_cam.translation();
  std::printf("%.6f %.6f %.6f %.6f %.6f %.6f %.6f %.6f\n", pose.time_s, p.x(), p.y(), p.z(), q.x(),
              q.y(), q.z(), q.w());
}

void feed_log(const char* log, oneac::FrontEnd& front_end) {
  mrpt::io::CFileGZInputStream file(log);
  auto archive = mrpt::serialization::archiveFrom(file);
  mrpt::obs::CActionCollection::Ptr action;
  mrpt::obs::CSensoryFrame::Ptr frame;
  mrpt::obs::CObservation::Ptr observation;
  std::size_t entry = 0;
  while (mrpt::obs::CRawlog::getActionObservationPairOrObservation(archive, action, frame,
                                                                   observation, entry)) {
    if (observation) front_end.feed(observation);  // this log holds plain observations only
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return std::fprintf(stderr, "usage: %s LOG IMAGES_DIR [HEIGHT]\n", argv[0]), 2;
  mrpt::img::CImage::setImagesPathBase(argv[2]);
  oneac::FrontEndOptions options;
  if (argc > 3) options.camera_height = std::atof(argv[3]);
  try {
    oneac::FrontEnd front_end(options);
    front_end.logging_enable_console_output = false;  // the poses go there
    feed_log(argv[1], front_end);
    front_end.finish();
    for (const oneac::FramePose& pose : front_end.trajectory().poses()) print_pose(pose);
    const std::size_t missing = front_end.fed().of(oneac::PassedOver::kMissing);
    if (missing > 0) std::fprintf(stderr, "%zu images are not there\n", missing);
  } catch (const std::exception& error) {  // an image or log that cannot be used, options
    return std::fprintf(stderr, "%s\n", error.what()), 2;
  }
}
