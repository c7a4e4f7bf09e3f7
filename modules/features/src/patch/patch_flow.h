#pragma once

#include "patch_alignment.h"

#include "oneac/features/feature_options.h"

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace oneac::internal {

/// A place to start looking: the warp expected, and the pyramid level whose capture range (about
/// half a window, 3 px · 2^level) covers its error. Level 1 is for a patch's own last motion, level
/// 0 for places foretold to about a pixel, where the affine alignment may begin at once.
struct FlowGuess {
  PatchWarp warp;
  std::size_t level = 0;
  bool foretells = false;  ///< a patch that is found there needs no way back
};

/// A patch found in the other image.
struct PatchMatch {
  PatchWarp warp;
  AlignmentQuality quality;
  std::size_t window = 0;  ///< where the search for this track's window starts in the next pair
};

/// What a track knows of its patch at level 0.
struct PatchMemory {
  const AnchoredPatch* patch = nullptr;  ///< made by anchor_adapted() at this place, or none
  std::size_t window = 0;                ///< else the window to try first
  bool knows_shape = false;              ///< guesses carry its A: no coarse alignment needed
};

/// Finds one patch of the first image in the second.
class PatchFlow {
 public:
  PatchFlow(const ImagePyramid& first, const ImagePyramid& second, const KltOptions& options)
      : first_(first), second_(second), options_(options) {}

  /// Coarse to fine from the guesses, in turn, until one fits; forward-backward gate; affine
  /// alignment. Empty when any gate refuses.
  [[nodiscard]] std::optional<PatchMatch> find(const Eigen::Vector2d& u1,
                                               const std::vector<FlowGuess>& guesses,
                                               const PatchMemory& memory);
  /// Whether the last find() saw the patch, even if a gate then refused it: another guess would
  /// come to the same.
  [[nodiscard]] bool has_seen() const { return has_seen_; }
  /// Affine alignment alone, from a warp already close (matched features).
  [[nodiscard]] std::optional<PatchMatch> refine(const Eigen::Vector2d& u1, const PatchWarp& start,
                                                 const PatchMemory& memory);

 private:
  static constexpr std::size_t kMaxLevels = 6;
  enum class State { kUnmade, kUsable, kUnusable };
  struct Found {
    PatchWarp warp;
    double zncc = -1.0;
  };

  [[nodiscard]] const AnchoredPatch* patch_at(std::size_t level, const PatchWarp& here);
  /// The patch of the affine alignment, made once for all attempts at a point.
  [[nodiscard]] const AnchoredPatch* fine_patch(const Eigen::Vector2d& u1,
                                                const PatchMemory& memory);
  /// How an affine alignment ended.
  struct Alignment {
    PatchMatch match;
    bool ended = false;  ///< somewhere in the image
    bool good = false;   ///< and all gates let it pass
  };
  [[nodiscard]] Alignment aligned(const Eigen::Vector2d& u1, const PatchWarp& start,
                                  const PatchMemory& memory);
  /// Whether the alignment ended where the patch was foretold, and at something like it.
  [[nodiscard]] bool is_there(const Alignment& alignment, const PatchWarp& foretold) const;
  [[nodiscard]] std::optional<Found> descend(const Eigen::Vector2d& u1, const FlowGuess& guess);
  /// Whether the patch lies where a guess that foretells was to bring it: prediction and image
  /// agree, which is what the way back would show.
  [[nodiscard]] bool is_foretold(const FlowGuess& guess, const PatchWarp& found) const;
  [[nodiscard]] bool returns(const Eigen::Vector2d& u1, const FlowGuess& guess,
                             const PatchWarp& found) const;

  std::array<AnchoredPatch, kMaxLevels> patches_;
  AnchoredPatch fine_;
  State fine_state_ = State::kUnmade;
  bool has_seen_ = false;
  const ImagePyramid& first_;
  const ImagePyramid& second_;
  const KltOptions& options_;
  std::array<int, kMaxLevels> state_{};  ///< 0 not made, 1 usable, −1 not usable
};

/// The patch at level 0 in the smallest window, not smaller than the one given, that determines its
/// affinity well.
[[nodiscard]] bool anchor_adapted(const ImagePyramid& image, const Eigen::Vector2d& u,
                                  AnchoredPatch& patch, std::size_t window = 0);
/// The window to try first at a corner of this score (corner_grid.h).
[[nodiscard]] std::size_t window_for_corner(float score);

}  // namespace oneac::internal
