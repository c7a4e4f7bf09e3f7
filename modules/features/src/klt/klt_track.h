#pragma once

#include "corner_grid.h"
#include "patch/patch_alignment.h"

#include "oneac/features/ac_extractor.h"

#include <cstddef>
#include <cstdint>
#include <memory>

namespace oneac::internal {

/// What is kept of one image.
class KltFrame : public FrameFeatures {
 public:
  ImagePyramid pyramid;
  GreyImage mask;  ///< of this image alone
  CornerGrid corners;
};

/// A patch that is being followed.
struct KltTrack {
  std::uint64_t id = 0;
  int age = 0;                                      ///< pairs it has lived through
  Eigen::Vector2d u = Eigen::Vector2d::Zero();      ///< in the anchor frame [px]
  Eigen::Vector2d flow = Eigen::Vector2d::Zero();   ///< of the last pair [px]
  Eigen::Matrix2d A = Eigen::Matrix2d::Identity();  ///< of the last pair
  Eigen::Matrix2d A_now_reference = Eigen::Matrix2d::Identity();
  std::unique_ptr<AnchoredPatch> reference;  ///< first patch; renewed when scale changes
  bool reference_is_here = false;            ///< it was taken at u in the anchor frame
  std::size_t window = 0;                    ///< to try first, PatchMatch::window
  int at_rest = 0;                           ///< pairs it rested while it had to move
  bool like_the_car = false;                 ///< it rests where only the car can, and did before
};

}  // namespace oneac::internal
