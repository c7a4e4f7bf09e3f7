#include "oneac/rawlog/calibration_writer.h"

#include "oneac/base/number_text.h"

#include <array>
#include <cstddef>

namespace oneac {

std::string calibration_text(const PinholeCamera& camera, const std::vector<std::string>& remarks) {
  std::string text;
  for (const std::string& remark : remarks) text += "// " + remark + "\n";
  text += "[CAMERA_PARAMS]\n";
  text +=
      "resolution = [" + std::to_string(camera.width) + " " + std::to_string(camera.height) + "]\n";
  text += "cx = " + exact_text(camera.cx) + "\ncy = " + exact_text(camera.cy) + "\n";
  text += "fx = " + exact_text(camera.fx) + "\nfy = " + exact_text(camera.fy) + "\n";
  std::array<double, 8> dist = camera.distortion;
  if (camera.lens == LensModel::kannala_brandt) {
    text += "distortion = kannala_brandt\n";
    dist = {dist[0], dist[1], 0.0, 0.0, dist[2], dist[3], 0.0, 0.0};  // in MRPT's places
  }
  text += "dist = [";
  for (std::size_t i = 0; i < dist.size(); ++i) {
    text += (i == 0 ? "" : " ") + exact_text(dist[i]);
  }
  return text + "]\n";
}

}  // namespace oneac
