#pragma once

#include "oneac/base/bound.h"

#include <string>

namespace oneac {

/// Descriptor matching.
struct MatchOptions {
  double snn_ratio =
      0.85;  ///< [-] nearest over second nearest distance; RootSIFT keeps 0.8…0.9 useful
  bool mutual = true;         ///< keep a match only when it is the nearest in both directions
  double max_shift_px = 500;  ///< [px] half a usual image: points that move farther leave it
  double max_scale =
      2.0;  ///< [-] largest ratio of areas' square roots: beyond it shapes do not match

  /// @throws std::invalid_argument naming field, value and bound
  void validate() const;
};

/// VLFeat: DoG + affine shape + orientation + SIFT, the extractor of the paper.
struct VlfeatOptions {
  int first_octave = 0;  ///< 0: full image size; −1 doubles the image, four times the cost
  double peak_threshold = 0.01;  ///< [grey of 0…1] DoG response; lower gives more, weaker features
  double edge_threshold = 10;    ///< [-] ratio of curvatures; Lowe's value
  int max_features = 3000;       ///< strongest DoG peaks kept; bounds the cost on busy images
  /// [Mpx] SIFT looks at no larger image, a larger one is shrunk for it: its scale space takes 270
  /// bytes a pixel, 0.5 GB for an image of that size
  double sift_megapixels = 2.0;

  /// @throws std::invalid_argument naming field, value and bound
  void validate() const;
};

/// Tracked corners with photometrically aligned patches.
struct KltOptions {
  int max_tracks = 700;  ///< some are lost from frame to frame: 500…600 correspondences remain
  int levels = 5;        ///< of the image pyramid: the coarsest sees 50 px of motion without a hint
  double min_distance_px = 10;     ///< [px] between corners: half a window, patches still differ
  double forward_backward_px = 1;  ///< [px] half a pixel of the level that it is tested at
  double min_zncc = 0.8;           ///< [-] 0.8: a fifth of the contrast is unexplained
  double max_affine_sigma = 0.05;  ///< [-] 1σ of an entry of A; worse ones are refused
  double drift_zncc = 0.7;         ///< [-] against the first patch of the track
  /// [-] of all tracks: where fewer are found, tracking broke and SIFT looks again; 0: never. Half
  /// of them survive three times the usual step.
  double broken_share = 0.2;
  double standing_px = 0.15;  ///< [px] median shift of near-identical images
  int static_frames = 5;      ///< a point that stays that long while it must move is no scene

  /// @throws std::invalid_argument naming field, value and bound
  void validate() const;
};

/// Parts of the image that are not used.
struct MaskOptions {
  std::string polygon;  ///< corners "u,v u,v u,v" [px], several polygons separated by ';'
  std::string image;    ///< grey picture of the camera's size: what is darker than 128 is not used
  bool learn = true;    ///< klt learns what is fixed to the car (bonnet) and leaves it out, too

  /// @throws std::invalid_argument naming field, value and bound
  void validate() const;
};

/// How affine correspondences are made. validate() throws std::invalid_argument naming field,
/// value and bound.
struct FeatureOptions {
  std::string extractor = "klt";  ///< "klt", "vlfeat", "vlfeat+align" or "sift"
  KltOptions klt;
  VlfeatOptions vlfeat;
  MatchOptions match;
  MaskOptions mask;

  /// @throws std::invalid_argument naming field, value and bound
  void validate() const;
};

/// Describes every option to a visitor: visit(key, field, unit, reason).
template <class Visitor>
void describe(Visitor&& visit, MatchOptions& o) {
  visit("snn_ratio", o.snn_ratio, "-", "nearest over second nearest descriptor distance",
        Bound::above_to(0, 1));
  visit("mutual", o.mutual, "bool", "keep only matches that are nearest in both directions");
  visit("max_shift_px", o.max_shift_px, "px", "largest image motion between two frames",
        Bound::positive());
  visit("max_scale", o.max_scale, "-", "largest change of scale of a matched shape",
        Bound::at_least(1));
}

template <class Visitor>
void describe(Visitor&& visit, VlfeatOptions& o) {
  visit("first_octave", o.first_octave, "-", "0: image size, -1: doubled image, 1: halved",
        Bound::from_to(-1, 4));
  visit("peak_threshold", o.peak_threshold, "grey 0..1", "smallest DoG response",
        Bound::at_least(0));
  visit("edge_threshold", o.edge_threshold, "-", "largest ratio of curvatures", Bound::at_least(1));
  visit("max_features", o.max_features, "count", "strongest features kept per image",
        Bound::positive());
  visit("sift_megapixels", o.sift_megapixels, "Mpx", "SIFT shrinks larger images; bounds memory",
        Bound::from_to(0.1, 100));
}

template <class Visitor>
void describe(Visitor&& visit, KltOptions& o) {
  visit("max_tracks", o.max_tracks, "count", "corners followed at a time", Bound::positive());
  visit("levels", o.levels, "count", "levels of the image pyramid", Bound::from_to(2, 6));
  visit("min_distance_px", o.min_distance_px, "px", "between corners", Bound::at_least(1));
  visit("forward_backward_px", o.forward_backward_px, "px", "largest error of the way back",
        Bound::positive());
  visit("min_zncc", o.min_zncc, "-", "least correlation of aligned patches", Bound::between(0, 1));
  visit("max_affine_sigma", o.max_affine_sigma, "-", "largest 1-sigma of an entry of A",
        Bound::positive());
  visit("drift_zncc", o.drift_zncc, "-", "least correlation with a track's first patch",
        Bound::between(0, 1));
  visit("broken_share", o.broken_share, "-", "share of tracks found below which SIFT looks again",
        Bound::from_to(0, 1));
  visit("standing_px", o.standing_px, "px", "median shift of near-identical images",
        Bound::at_least(0));
  visit("static_frames", o.static_frames, "frames", "points at rest for so long are dropped",
        Bound::positive());
}

template <class Visitor>
void describe(Visitor&& visit, MaskOptions& o) {
  visit("polygon", o.polygon, "px", "not used: \"u,v u,v u,v\", several separated by ;");
  visit("image", o.image, "path", "picture whose dark pixels are not used");
  visit("learn", o.learn, "bool", "find what is fixed to the car over the drive, do not use it");
}

template <class Visitor>
void describe(Visitor&& visit, FeatureOptions& o) {
  visit("extractor", o.extractor, "name", "how correspondences are found",
        Bound::one_of("klt, vlfeat, vlfeat+align or sift"));
  visit.section("klt", o.klt);
  visit.section("vlfeat", o.vlfeat);
  visit.section("match", o.match);
  visit.section("mask", o.mask);
}

}  // namespace oneac
