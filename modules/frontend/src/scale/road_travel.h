#pragma once

#include "attitude/levelling.h"
#include "inertia.h"
#include "measurements.h"
#include "two_view/two_view.h"

#include "oneac/base/image.h"
#include "oneac/features/road_alignment.h"
#include "oneac/geometry/camera.h"

#include <Eigen/Core>

#include <optional>

namespace oneac {

/// The road of the two images of a step. Empty images: nobody looks at pixels.
struct RoadPair {
  RoadImage first, second;
  PinholeCamera camera;
  ImageView mask;  ///< dark where pixels are masked or the car's own; empty: all are road or scene
  bool car_is_known = true;    ///< nothing of the car is left beside the mask; else that may rest
  bool shows_travel = false;   ///< images show travel by themselves, whatever rests in them
  bool through_dirt = false;   ///< what rests in the images may be drops or dirt on the glass
  Workers* workers = nullptr;  ///< who share the look at them; none: the calling thread alone

  [[nodiscard]] bool empty() const { return first.empty() || second.empty(); }
};

/// Where a step is looked for on the road.
struct RoadTravelPrior {
  Levelling first;          ///< of the first view
  Eigen::Vector3d heading;  ///< t̂ of a camera that goes on as it did, for a step without direction
  std::optional<ExpectedLength> expected;
  double seconds = 0.0;
  double camera_height = 0.0;  ///< [m]; 0: not known, lengths are in camera heights then
};

/// What the road says of a step.
struct RoadTravel {
  std::optional<MeasuredTravel> travel;  ///< how long it was, if the road tells
  bool repeats = false;  ///< another length fits as well: slabs, dashes, stripes; corners slip, too
};

/// Aligns the road of a step photometrically along the direction of two views, or along the heading
/// where they found none.
[[nodiscard]] RoadTravel road_travel(const RoadPair& road, const TwoView& seen,
                                     const RoadTravelPrior& prior);

}  // namespace oneac
