#pragma once

#include "cholesky.h"
#include "patch_window.h"

namespace oneac::internal {

/// A patch of the first image at one level, made ready for alignment.
struct AnchoredPatch {
  PatchTemplate patch;  // first: aligned more strictly than the others
  const PatchWindow* window = nullptr;
  std::size_t level = 0;
  Eigen::Matrix2d M = Eigen::Matrix2d::Identity();  ///< pixels of the window to those of the image
  SpdInverse<kAffineParameters>
      inverse;  ///< of the normal matrix; expected_affine_sigma() fills it
  bool inverted = false;
  std::size_t next_window = 0;  ///< index of the window to try first at this point's next place
};

/// Takes the patch at `here` (centre in px of level 0, M of the patch). False when it sticks out of
/// the image or is blank.
[[nodiscard]] bool anchor_patch(const ImagePyramid& pyramid, std::size_t level,
                                const PatchWindow& window, const PatchWarp& here,
                                AnchoredPatch& patch);
/// The patch at u [px of level 0] as the image shows it.
[[nodiscard]] bool anchor_patch(const ImagePyramid& pyramid, std::size_t level,
                                const PatchWindow& window, const Eigen::Vector2d& u,
                                AnchoredPatch& patch);

/// How well a patch lies in the other image.
struct AlignmentQuality {
  double zncc = -1.0;         ///< zero-mean normalised cross-correlation, window's weights
  double affine_sigma = 0.0;  ///< 1σ of an entry of A [-]; root mean square of the four
  double point_sigma = 0.0;   ///< 1σ of the point per axis [px of level 0]
  Eigen::Matrix2d perspective = Eigen::Matrix2d::Zero();  ///< see Correspondence [px² of level 0]
};

/// Inverse compositional alignment of shift, gain and bias. The window's pixels are the other
/// image's: a deformation known beforehand goes into the patch, as the inverse of warp.M. False
/// when it leaves the image, diverges or the patch does not determine it. `warp` is where it starts
/// and where it ends; its M is not looked at and stays.
/// @pre the window has padded rows
[[nodiscard]] bool align_shift(const AnchoredPatch& patch, const ImagePyramid& image,
                               PatchWarp& warp, AlignmentQuality& quality);

/// The same for all six affine parameters, M from the patch's window to the image; then once more
/// with Tukey's weights from the residuals, and with the covariance when `robust`.
[[nodiscard]] bool align_affine(const AnchoredPatch& patch, const ImagePyramid& image, bool robust,
                                PatchWarp& warp, AlignmentQuality& quality);

/// Zero-mean normalised cross-correlation with the other image at a warp as it is; −1 outside.
[[nodiscard]] double compare_patch(const AnchoredPatch& patch, const ImagePyramid& image,
                                   const PatchWarp& warp);

/// 1σ of an entry of A that alignment of this patch would have under noise of one grey level,
/// infinite when it does not determine A. The patch keeps the inverse for its alignment.
[[nodiscard]] double expected_affine_sigma(AnchoredPatch& patch);

}  // namespace oneac::internal
