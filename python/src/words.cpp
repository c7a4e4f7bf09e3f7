#include "words.h"

#include <pybind11/pybind11.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace oneac::python {
namespace {

namespace py = pybind11;

struct Word {
  std::string_view flag;      ///< as messages write it
  std::string_view argument;  ///< in its place
};

// Longer ones go before what they begin with.
constexpr std::array kOfRawlog{
    Word{"--calibration FILE[:SECTION]", "calibration='FILE[:SECTION]' or a Camera"},
    Word{"--mount-roll, --mount-pitch and --mount-yaw", "mount_deg"},
    Word{"--calibration", "calibration"},
    Word{"--camera", "camera"},
    Word{"--every", "every"},
    Word{"--images-dir", "images_dir"},
    Word{"--mask-dir", "mask_dir"},
    Word{"--mount-convention", "mount_convention"},
    Word{"--undistorted-fov", "undistorted_fov_deg"},
};

// Angles of the mount are those of oneac.mount().
constexpr std::array kOfFrontEnd{
    Word{"--calibration FILE[:SECTION], or set the observations' cameraParams", "camera"},
    Word{"--mount-yaw, --mount-roll and --mount-pitch, or --mount-convention", "T_vehicle_cam"},
    Word{"--calibration FILE[:SECTION]", "camera"},
    Word{"--calibration", "camera"},
    Word{"--camera-height", "camera_height"},
    Word{"--mount-pitch", "pitch_up_deg"},
    Word{"--mount-roll", "roll_right_deg"},
    Word{"--mount-yaw", "yaw_left_deg"},
};

bool begins_with(std::string_view text, std::string_view begin) {
  return text.substr(0, begin.size()) == begin;
}

bool goes_on(std::string_view text) {
  return !text.empty() && (text[0] == '-' || std::isalnum(static_cast<unsigned char>(text[0])));
}

/// The word that the text begins with, as a whole; null for none.
template <class Words>
const Word* word_at(std::string_view text, const Words& words) {
  const auto found = std::find_if(words.begin(), words.end(), [&](const Word& word) {
    return begins_with(text, word.flag) && !goes_on(text.substr(word.flag.size()));
  });
  return found == words.end() ? nullptr : &*found;
}

bool is_value(std::string_view text) {
  if (text.size() < 2 || text[0] != ' ') return false;
  const bool sign = text[1] == '-' && text.size() > 2;
  return std::isdigit(static_cast<unsigned char>(text[sign ? 2 : 1])) != 0;
}

template <class Words>
std::string told(std::string_view message, const Words& words) {
  std::string text;
  while (!message.empty()) {
    const bool begins = text.empty() || text.back() == ' ' || text.back() == '(';
    const Word* word = begins ? word_at(message, words) : nullptr;
    if (word == nullptr) {
      text += message.front();
      message.remove_prefix(1);
      continue;
    }
    text += word->argument;
    message.remove_prefix(word->flag.size());
    if (!is_value(message)) continue;
    text += '=';
    message.remove_prefix(1);
  }
  return text;
}

}  // namespace

std::string in_python(std::string_view message, Asked asked) {
  return asked == Asked::kRawlog ? told(message, kOfRawlog) : told(message, kOfFrontEnd);
}

void throw_input_error(const std::string& message) {
  const py::object type = py::module_::import("oneac._oneac").attr("InputError");
  PyErr_SetString(type.ptr(), message.c_str());
  throw py::error_already_set();
}

}  // namespace oneac::python
