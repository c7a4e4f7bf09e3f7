// A KITTI sequence: calib.txt, times.txt and poses.txt, parted by form feeds; the images are sound.
#include "fuzz.h"

#include "oneac/base/error.h"
#include "oneac/rawlog/import_kitti.h"
#include "oneac/test_support/temporary_folder.h"

#include <opencv2/imgcodecs.hpp>

#include <fstream>

namespace {

namespace fs = std::filesystem;

/// The folder that every input shares, with two images.
const fs::path& sequence() {
  static const oneac::TemporaryFolder folder;
  static const fs::path path = [] {
    fs::create_directory(folder.path() / "image_0");
    for (const char* name : {"000000.png", "000001.png"}) {
      cv::imwrite((folder.path() / "image_0" / name).string(), cv::Mat(8, 8, CV_8U));
    }
    return folder.path();
  }();
  return path;
}

void write_parts(std::string_view data) {
  for (const char* name : {"calib.txt", "times.txt", "poses.txt"}) {
    const std::size_t end = std::min(data.find('\f'), data.size());
    fs::remove(sequence() / name);
    if (end > 0) std::ofstream(sequence() / name, std::ios::binary) << data.substr(0, end);
    data.remove_prefix(std::min(end + 1, data.size()));
  }
}

}  // namespace

ONEAC_FUZZ_TARGET(kitti_folder) {
  write_parts(data);
  oneac::KittiImport options;
  options.source = sequence();
  options.log = sequence() / "out.rawlog";
  fs::remove(options.log);
  try {
    const oneac::ImportReport report = oneac::import_kitti(options);
    oneac::fuzz::check(report.images == 2 && fs::exists(options.log), "a log of both images");
  } catch (const oneac::InputError&) {  // what it may throw
    oneac::fuzz::check(!fs::exists(options.log), "no log of a refused sequence");
  }
}
