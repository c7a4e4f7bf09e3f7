#pragma once

#include "oneac/geometry/camera.h"

#include <string>
#include <vector>

namespace oneac {

/// Why a calibration cannot be that of these images, one line each, with the numbers; empty when
/// nothing speaks against it.
///
/// A pinhole camera of a vehicle sees from 10° to 150° along the longer side of its images (10°
/// is a telephoto lens of 5.7 image widths; beyond 150° a pinhole image is mostly rim), its
/// pixels are square to a quarter, and its principal point lies in the middle half of the image
/// in each direction. What is beyond is the K of another image size, one whose entries are
/// swapped, or a placeholder.
/// @pre fx and fy are positive; width and height are those of the images, or 0 when not known:
///      then nothing can be said
[[nodiscard]] std::vector<std::string> camera_faults(const PinholeCamera& camera);

/// Why no camera can be so, whatever its images: a focal length below 1 px or above 10⁶ px, a
/// principal point further than 10⁶ px away, a lens that folds or stretches the image more than
/// twentyfold within the circle that fits into it. One line with the numbers; "" otherwise.
/// @pre as camera_faults
[[nodiscard]] std::string impossible_camera(const PinholeCamera& camera);

}  // namespace oneac
