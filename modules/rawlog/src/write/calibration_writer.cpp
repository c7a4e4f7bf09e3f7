#include "oneac/rawlog/calibration_writer.h"

#include "oneac/base/number_text.h"

namespace oneac {

std::string calibration_text(const PinholeCamera& camera, const std::vector<std::string>& remarks) {
  std::string text;
  for (const std::string& remark : remarks) text += "// " + remark + "\n";
  text += "[CAMERA_PARAMS]\n";
  text +=
      "resolution = [" + std::to_string(camera.width) + " " + std::to_string(camera.height) + "]\n";
  text += "cx = " + exact_text(camera.cx) + "\ncy = " + exact_text(camera.cy) + "\n";
  text += "fx = " + exact_text(camera.fx) + "\nfy = " + exact_text(camera.fy) + "\ndist = [";
  for (std::size_t i = 0; i < camera.distortion.size(); ++i) {
    text += (i == 0 ? "" : " ") + exact_text(camera.distortion[i]);
  }
  return text + "]\n";
}

}  // namespace oneac
