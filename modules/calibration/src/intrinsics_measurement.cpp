#include "oneac/calibration/intrinsics_measurement.h"

#include "window_adjustment.h"

#include "oneac/base/require.h"

#include <algorithm>

namespace oneac {
namespace {

// Tracks below which a window is not asked: a handful of crossing cars would answer.
constexpr std::size_t kFewestTracks = 40;
constexpr std::size_t kFewestViews = 3;

// Relative falls of the cost that end a search. Where a few tracks are wrong, the Cauchy loss lets
// it creep on for long: of a cost near 2000 the last search leaves a tenth of a σ of its weakest
// unknowns, mostly depths of far points. The first one only says how large the residuals are.
constexpr double kForNoise = 1e-3, kForCamera = 1e-5;

double weight_of(double sigma) {
  return 1.0 / (sigma * sigma);
}

}  // namespace

IntrinsicsMatrix IntrinsicsPrior::information() const {
  IntrinsicsVector diagonal;
  diagonal << weight_of(focal), weight_of(centre), weight_of(centre), weight_of(k1), weight_of(k2);
  return diagonal.asDiagonal();
}

void IntrinsicsPrior::validate() const {
  require(focal > 0.0 && focal <= 1.0, "prior: focal", focal, "above 0, up to 1");
  require(centre > 0.0 && centre <= 1.0, "prior: centre", centre, "above 0, up to 1");
  require(k1 > 0.0 && k1 <= 10.0, "prior: k1", k1, "above 0, up to 10");
  require(k2 > 0.0 && k2 <= 10.0, "prior: k2", k2, "above 0, up to 10");
}

std::optional<IntrinsicsMeasurement> measure_intrinsics(const CalibrationWindow& window,
                                                        const PinholeCamera& from,
                                                        const IntrinsicsVector& start,
                                                        const IntrinsicsPrior& prior,
                                                        const MeasurementOptions& options) {
  from.validate();
  prior.validate();
  if (window.views.size() < kFewestViews) return std::nullopt;
  WindowAdjustment adjustment(window, from, start, options);
  if (adjustment.tracks() < kFewestTracks) return std::nullopt;
  const IntrinsicsMatrix known = prior.information();
  if (!adjustment.solve(known, options.point_noise_px, kForNoise)) return std::nullopt;
  const double sigma = std::max(adjustment.noise_px(), options.least_noise_px);
  if (!adjustment.solve(known, sigma, kForCamera)) return std::nullopt;
  IntrinsicsMeasurement result;
  result.change = adjustment.change();
  result.information = adjustment.information(sigma);
  // At the minimum: information (change − best) + prior change = 0.
  result.pull = result.information * result.change + known * result.change;
  result.residual_px = sigma;
  result.tracks = adjustment.tracks();
  result.sightings = adjustment.sightings();
  result.turn = turn_of(window);
  if (!result.information.allFinite() || !result.pull.allFinite()) return std::nullopt;
  return result;
}

std::vector<SightingResidual> residuals_with(const CalibrationWindow& window,
                                             const PinholeCamera& camera,
                                             const MeasurementOptions& options) {
  constexpr double kHeld = 1e12;  // [-] information that lets no camera move
  camera.validate();
  if (window.views.size() < kFewestViews) return {};
  WindowAdjustment adjustment(window, camera, IntrinsicsVector::Zero(), options);
  const IntrinsicsMatrix held = kHeld * IntrinsicsMatrix::Identity();
  if (adjustment.tracks() < kFewestTracks ||
      !adjustment.solve(held, options.point_noise_px, kForCamera)) {
    return {};
  }
  std::vector<SightingResidual> result;
  for (const auto& [u, r] : adjustment.residuals()) result.push_back({u, r.norm()});
  return result;
}

}  // namespace oneac
