#pragma once

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

  void validate() const;
};

/// VLFeat: DoG + affine shape + orientation + SIFT, the extractor of the paper.
struct VlfeatOptions {
  int first_octave = 0;  ///< 0: full image size; −1 doubles the image, four times the cost
  double peak_threshold = 0.01;  ///< [grey of 0…1] DoG response; lower gives more, weaker features
  double edge_threshold = 10;    ///< [-] ratio of curvatures; Lowe's value
  int max_features = 3000;       ///< strongest DoG peaks kept; bounds the cost on busy images

  void validate() const;
};

/// How affine correspondences are made. validate() throws std::invalid_argument naming field,
/// value and bound.
struct FeatureOptions {
  std::string extractor = "vlfeat";  ///< "vlfeat"
  VlfeatOptions vlfeat;
  MatchOptions match;

  void validate() const;
};

/// Describes every option to a visitor: visit(key, field, unit, reason).
template <class Visitor>
void describe(Visitor&& visit, MatchOptions& o) {
  visit("snn_ratio", o.snn_ratio, "-", "nearest over second nearest descriptor distance");
  visit("mutual", o.mutual, "bool", "keep only matches that are nearest in both directions");
  visit("max_shift_px", o.max_shift_px, "px", "largest image motion between two frames");
  visit("max_scale", o.max_scale, "-", "largest change of scale of a matched shape");
}

template <class Visitor>
void describe(Visitor&& visit, VlfeatOptions& o) {
  visit("first_octave", o.first_octave, "-", "0: image size, -1: doubled image, 1: halved");
  visit("peak_threshold", o.peak_threshold, "grey 0..1", "smallest DoG response");
  visit("edge_threshold", o.edge_threshold, "-", "largest ratio of curvatures");
  visit("max_features", o.max_features, "count", "strongest features kept per image");
}

template <class Visitor>
void describe(Visitor&& visit, FeatureOptions& o) {
  visit("extractor", o.extractor, "name", "vlfeat");
  visit.section("vlfeat", o.vlfeat);
  visit.section("match", o.match);
}

}  // namespace oneac
