// Feeds a rawlog to oneac::FrontEnd and prints the camera's poses as TUM rows.
//   consumer LOG.rawlog IMAGES_DIR [CAMERA_HEIGHT]
#include <oneac/base/error.h>
#include <oneac/frontend/front_end.h>

#include <mrpt/img/CImage.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/serialization/CArchive.h>

#include <Eigen/Geometry>

#include <cstdio>
#include <cstdlib>

namespace {

void print_pose(double time_s, const Eigen::Isometry3d& T) {
  const Eigen::Quaterniond q(T.linear());
  const Eigen::Vector3d p = T.translation();
  std::printf("%.6f %.6f %.6f %.6f %.6f %.6f %.6f %.6f\n", time_s, p.x(), p.y(), p.z(), q.x(),
              q.y(), q.z(), q.w());
}

void drive(const char* log, const oneac::FrontEndOptions& options) {
  mrpt::io::CFileGZInputStream file(log);
  auto archive = mrpt::serialization::archiveFrom(file);
  oneac::FrontEnd front_end(options);
  mrpt::obs::CActionCollection::Ptr action;
  mrpt::obs::CSensoryFrame::Ptr frame;
  mrpt::obs::CObservation::Ptr observation;
  std::size_t entry = 0;
  while (mrpt::obs::CRawlog::getActionObservationPairOrObservation(archive, action, frame,
                                                                   observation, entry)) {
    if (!observation) continue;  // this log holds plain observations only
    if (const auto result = front_end.feed(observation)) {
      print_pose(result->time_s, result->T_first_cam);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return std::fprintf(stderr, "usage: %s LOG IMAGES_DIR [HEIGHT]\n", argv[0]), 2;
  mrpt::img::CImage::setImagesPathBase(argv[2]);
  oneac::FrontEndOptions options;
  if (argc > 3) options.camera_height = std::atof(argv[3]);
  try {
    drive(argv[1], options);
  } catch (const oneac::InputError& error) {
    return std::fprintf(stderr, "%s\n", error.what()), 2;
  }
}
