#include "patch_flow.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace oneac::internal {
namespace {

// [px of the level] window of the shift: 113 samples see texture enough for two unknowns.
constexpr double kFlowRadius = 6.0;
// [px of the level] a deformation that moves the rim by less is left to the affine alignment: the
// window is symmetric, the shift hardly feels it.
constexpr double kSameShape = 0.25;
constexpr double kCoarseAffineRadius = 7.0;  // [px of level 1]
constexpr double kFits = 0.9;                // [ZNCC] a guess that fits so well ends the search
constexpr double kDoubtful = 0.5;        // [ZNCC at level 1] below it no guess has found the patch
constexpr double kCapture = 3.0;         // [px of the level] half a window
constexpr double kMaxCorrection = 4.0;   // [px] affine alignment only polishes what the flow found
constexpr double kMaxDeformation = 0.6;  // [-] |A − A0|: beyond it the linearisation is fiction
// Windows at level 0, and the σ of an entry of A [-] under noise of one grey level that makes the
// next larger one unnecessary: noise of 2 grey levels in both images then leaves A better than
// 0.01.
constexpr double kRadii[] = {8.0, 11.0, 14.0};
constexpr double kGoodSigma = 0.0025;
// The larger windows look at every second row: level 0 is smoothed, so that each row of the image
// has the same weight in them and noise costs nothing more (patch_alignment.cpp).
constexpr int kRowStep = 2;
// With the window's size n the σ of an entry of A falls as n⁻²: (8/11)² is about a half. A patch
// that is clearly better than that may do with the next smaller window, and will not swing back.
constexpr double kShrinkSigma = 0.35 * kGoodSigma;
// The same σ from a corner's score s, were its gradients those of the whole window: Σ w gx² x² / r²
// is π r² / 6 times their mean square, and s sums (2 · 2 g)² over 7×7 pixels of level 1. A window
// is passed over without a look when that is twice the bound.
constexpr double kCornerSigma = 620.0;
constexpr double kHopeless = 2.0;

const PatchWindow& flow_window() {
  static const PatchWindow window = padded_window(kFlowRadius);
  return window;
}

const PatchWindow& coarse_affine_window() {
  static const PatchWindow window = round_window(kCoarseAffineRadius);
  return window;
}

const PatchWindow& fine_window(std::size_t i) {
  static const std::array<PatchWindow, 3> windows = {round_window(kRadii[0]),
                                                     round_window(kRadii[1], kRowStep),
                                                     round_window(kRadii[2], kRowStep)};
  return windows[i];
}

bool same_shape(const Eigen::Matrix2d& one, const Eigen::Matrix2d& two) {
  return (one - two).squaredNorm() * kFlowRadius * kFlowRadius < kSameShape * kSameShape;
}

/// M, or the identity where it does as well: patches as the image shows them are made faster.
Eigen::Matrix2d shape(const Eigen::Matrix2d& M) {
  const Eigen::Matrix2d I = Eigen::Matrix2d::Identity();
  return same_shape(M, I) ? I : M;
}

}  // namespace

std::size_t window_for_corner(float score) {
  std::size_t i = 0;
  const double best = kCornerSigma / std::sqrt(static_cast<double>(score));
  while (i + 1 < std::size(kRadii) && best > kHopeless * kGoodSigma * kRadii[i] * kRadii[i]) ++i;
  return i;
}

bool anchor_adapted(const ImagePyramid& image, const Eigen::Vector2d& u, AnchoredPatch& patch,
                    std::size_t window) {
  for (std::size_t i = window; i < std::size(kRadii); ++i) {
    if (!anchor_patch(image, 0, fine_window(i), u, patch)) {
      patch.next_window = i > 0 ? i - 1 : 0;
      return i > 0 && anchor_patch(image, 0, fine_window(i - 1), u, patch);
    }
    patch.next_window = i;
    const double sigma = expected_affine_sigma(patch);
    if (sigma < kShrinkSigma && i > 0) patch.next_window = i - 1;
    if (sigma < kGoodSigma) break;
  }
  return true;
}

const AnchoredPatch* PatchFlow::patch_at(std::size_t level, const PatchWarp& here) {
  if (state_[level] == 0 || !same_shape(patches_[level].M, here.M)) {
    state_[level] = anchor_patch(first_, level, flow_window(), here, patches_[level]) ? 1 : -1;
  }
  return state_[level] == 1 ? &patches_[level] : nullptr;
}

std::optional<PatchFlow::Found> PatchFlow::descend(const Eigen::Vector2d& u1,
                                                   const FlowGuess& guess) {
  Found found{guess.warp, -1.0};
  PatchWarp here;
  here.M = shape(guess.warp.M.inverse());
  here.centre = u1;
  const std::size_t top = std::min({guess.level, first_.levels.size() - 1, kMaxLevels - 1});
  for (std::size_t level = top; level >= 1; --level) {
    const AnchoredPatch* patch = patch_at(level, here);
    if (patch == nullptr) {
      if (level > 1) continue;  // blank when shrunk so far: the next level may show something
      return std::nullopt;
    }
    AlignmentQuality quality;
    PatchWarp warp = found.warp;
    if (align_shift(*patch, second_, warp, quality)) {
      found = {warp, quality.zncc};
    } else if (level == 1) {
      return std::nullopt;
    }
  }
  return found;
}

bool PatchFlow::returns(const Eigen::Vector2d& u1, const FlowGuess& guess,
                        const PatchWarp& found) const {
  PatchWarp here, back;
  here.M = shape(guess.warp.M);
  here.centre = found.centre;
  back.centre = found.centre - (guess.warp.centre - u1);
  AnchoredPatch patch;
  AlignmentQuality quality;
  // The way back starts as far off as the guess was, at the level that captures so much.
  const double error = (found.centre - guess.warp.centre).norm();
  const std::size_t top = std::min(guess.level, first_.levels.size() - 1);
  std::size_t level = 1;
  while (level < top && error > kCapture * std::ldexp(1.0, static_cast<int>(level))) ++level;
  for (; level >= 1; --level) {
    if (!anchor_patch(second_, level, flow_window(), here, patch)) continue;
    if (!align_shift(patch, first_, back, quality) && level == 1) return false;
  }
  return (back.centre - u1).norm() <= options_.forward_backward_px;
}

std::optional<PatchMatch> PatchFlow::find(const Eigen::Vector2d& u1,
                                          const std::vector<FlowGuess>& guesses,
                                          const PatchMemory& memory) {
  state_.fill(0);
  fine_state_ = State::kUnmade;
  has_seen_ = false;
  Found best;
  const FlowGuess* origin = nullptr;
  for (const FlowGuess& guess : guesses) {
    if (guess.level == 0) {
      const Alignment alignment = aligned(u1, guess.warp, memory);
      has_seen_ = is_there(alignment, guess.warp);
      if (!has_seen_) continue;
      return alignment.good ? std::optional(alignment.match) : std::nullopt;
    }
    const auto found = descend(u1, guess);
    if (!found || found->zncc <= best.zncc) continue;
    best = *found;
    origin = &guess;
    if (best.zncc > kFits) break;
  }
  if (origin == nullptr || best.zncc < kDoubtful) return std::nullopt;
  has_seen_ = true;
  if (!is_foretold(*origin, best.warp) && !returns(u1, *origin, best.warp)) return std::nullopt;
  const Alignment alignment = aligned(u1, best.warp, memory);
  return alignment.good ? std::optional(alignment.match) : std::nullopt;
}

bool PatchFlow::is_there(const Alignment& alignment, const PatchWarp& foretold) const {
  const Eigen::Vector2d off = alignment.match.warp.centre - foretold.centre;
  return alignment.ended && off.norm() <= options_.forward_backward_px &&
         alignment.match.quality.zncc >= kDoubtful;
}

const AnchoredPatch* PatchFlow::fine_patch(const Eigen::Vector2d& u1, const PatchMemory& memory) {
  if (memory.patch != nullptr) return memory.patch;
  if (fine_state_ == State::kUnmade) {
    const bool made = anchor_adapted(first_, u1, fine_, memory.window);
    fine_state_ = made ? State::kUsable : State::kUnusable;
  }
  return fine_state_ == State::kUsable ? &fine_ : nullptr;
}

bool PatchFlow::is_foretold(const FlowGuess& guess, const PatchWarp& found) const {
  return guess.foretells &&
         (found.centre - guess.warp.centre).norm() <= options_.forward_backward_px;
}

std::optional<PatchMatch> PatchFlow::refine(const Eigen::Vector2d& u1, const PatchWarp& start,
                                            const PatchMemory& memory) {
  fine_state_ = State::kUnmade;
  const Alignment alignment = aligned(u1, start, memory);
  return alignment.good ? std::optional(alignment.match) : std::nullopt;
}

PatchFlow::Alignment PatchFlow::aligned(const Eigen::Vector2d& u1, const PatchWarp& start,
                                        const PatchMemory& memory) {
  AnchoredPatch patch;
  Alignment result{{start, {}}};
  PatchMatch& match = result.match;
  if (!memory.knows_shape && first_.levels.size() > 1 &&
      anchor_patch(first_, 1, coarse_affine_window(), u1, patch)) {
    PatchWarp warp = start;
    if (align_affine(patch, second_, false, warp, match.quality) &&
        match.quality.zncc >= options_.min_zncc) {
      match.warp = warp;
    }
  }
  const AnchoredPatch* const fine = fine_patch(u1, memory);
  if (fine == nullptr) return result;
  match.window = fine->next_window;
  result.ended = align_affine(*fine, second_, true, match.warp, match.quality);
  result.good = result.ended && match.quality.zncc >= options_.min_zncc &&
                match.quality.affine_sigma <= options_.max_affine_sigma &&
                (match.warp.centre - start.centre).norm() <= kMaxCorrection &&
                (match.warp.M - start.M).norm() <= kMaxDeformation;
  return result;
}

}  // namespace oneac::internal
