#pragma once

#include "oneac/base/bound.h"
#include "oneac/geometry/relative_pose.h"

#include <Eigen/Core>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace oneac {

class Workers;

/// Sliding-window bundle adjustment. validate() throws std::invalid_argument.
struct WindowRefineOptions {
  double point_noise_px = 0.2;     ///< [px] 1σ of a tracked point where the track does not say
  double affine_noise = 0.05;      ///< [-] 1σ of an entry of A where the track does not say
  double loss_sigmas = 1.0;        ///< [σ] scale of the Cauchy loss, as in RefineOptions
  double affine_gate_chi2 = 13.3;  ///< [-] χ² of the four entries of A; 99 % of Gaussian pass
  /// fast: the points' cost by the module's own solver. ceres: the same cost by Ceres, its tested
  /// reference. ceres+affine: Ceres, and the consistent affinities move the poses too.
  std::string solver = "fast";
  double suspension_deg = 1.5;        ///< [deg] 1σ of roll and pitch from one keyframe to the next
  double travel_elevation_deg = 3.0;  ///< [deg] 1σ of the elevation of travel
  int max_iterations = 10;            ///< bounds the time: a warm start needs three to six

  /// Affinities are in the cost: solver "ceres+affine".
  [[nodiscard]] bool affine_terms() const { return solver == "ceres+affine"; }
  /// @throws std::invalid_argument naming field, value and bound
  void validate() const;
};

template <class Visitor>
void describe(Visitor&& visit, WindowRefineOptions& o) {
  visit("point_noise_px", o.point_noise_px, "px", "1 sigma of a tracked point",
        Bound::positive_and_finite());
  visit("affine_noise", o.affine_noise, "-", "1 sigma of an entry of the affinity",
        Bound::positive_and_finite());
  visit("loss_sigmas", o.loss_sigmas, "sigma", "scale of the robust (Cauchy) loss",
        Bound::positive_and_finite());
  visit("affine_gate_chi2", o.affine_gate_chi2, "-", "affinities beyond it are left out",
        Bound::positive_and_finite());
  visit("solver", o.solver, "name", "fast, ceres (the same cost) or ceres+affine (affinities too)",
        Bound::one_of("fast, ceres or ceres+affine"));
  visit("suspension_deg", o.suspension_deg, "deg", "1-sigma of roll and pitch between keyframes",
        Bound::positive_and_finite());
  visit("travel_elevation_deg", o.travel_elevation_deg, "deg", "1-sigma of the elevation of travel",
        Bound::positive_and_finite());
  visit("max_iterations", o.max_iterations, "count", "steps of the optimiser", Bound::at_least(1));
}

/// A small planar patch of the scene: a point and the gradient of its inverse depth, all in the
/// anchor view. Around the point the inverse depth is ρ + g·δ, so the patch is the plane n·X = d
/// with n/d = (g, ρ − g·x).
struct WindowLandmark {
  std::size_t anchor = 0;                              ///< view whose frame holds the landmark
  Eigen::Vector2d x = Eigen::Vector2d::Zero();         ///< its ray in the anchor view [-]
  double inverse_depth = 0.0;                          ///< ρ [1/length of the map]
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();  ///< g [1/length]
  bool has_gradient = false;                           ///< an affinity has determined it
};

/// What one view measured of one landmark.
struct WindowObservation {
  std::size_t landmark = 0;
  std::size_t view = 0;
  Eigen::Vector2d x = Eigen::Vector2d::Zero();      ///< [-]
  Eigen::Matrix2d A = Eigen::Matrix2d::Identity();  ///< ∂x/∂(anchor's x) [-]
  double point_sigma = 0.0;        ///< 1σ of a coordinate [-]; 0: options.point_noise_px
  double affine_sigma = 0.0;       ///< 1σ of an entry of A [-]; 0: options.affine_noise
  bool affine_consistent = false;  ///< set by refine_window: A agrees with pose and patch
};

/// One keyframe. T_view_map: X_view = R X_map + t.
struct WindowView {
  RelativePose T_view_map;
  bool fixed = false;  ///< holds the gauge
};

/// The problem and, after refine_window, its solution.
struct SlidingWindow {
  std::vector<WindowView> views;
  std::vector<WindowLandmark> landmarks;
  std::vector<WindowObservation>
      observations;  ///< of views other than the anchor, and the anchor's
  Eigen::Matrix3d R_level_cam = Eigen::Matrix3d::Identity();  ///< for the planar-motion prior
  double focal_px = 1.0;
};

/// How the window came out.
struct WindowRefineResult {
  bool usable = false;        ///< the window holds the solution; else it is as it was
  double initial_cost = 0.0;  ///< ½ Σ ρ(|r|²)
  double final_cost = 0.0;
  int iterations = 0;
  std::size_t affine_consistent = 0;  ///< observations
};

/// Bundle adjustment over keyframes and landmarks of a window: reprojection of every observation,
/// the affinity of the affine-consistent ones (when asked), each in standard deviations under a
/// Cauchy loss, and a planar-motion prior between consecutive views as soft as the suspension.
///
/// Gauge: views marked `fixed` keep their poses; two of them hold position, orientation and scale.
/// With one, scale is left to the damping of the optimiser: it stays near the start. An observation
/// is affine-consistent when its A agrees within its noise with the affinity that poses and patch
/// induce; patches get their gradient by least squares over all their affinities. Landmarks are
/// eliminated (Schur); with affine terms Ceres does it. No clock: deterministic.
/// @throws std::invalid_argument on invalid options or an index out of range
[[nodiscard]] WindowRefineResult refine_window(SlidingWindow& window,
                                               const WindowRefineOptions& options);

/// refine_window() for one window after the other, in the same memory and on several threads. Its
/// results are the same to the last bit.
class WindowRefiner {
 public:
  /// @param workers  who shares the work, without affine terms; outlives this. None: the calling
  ///                 thread alone
  explicit WindowRefiner(Workers* workers = nullptr);
  ~WindowRefiner();
  WindowRefiner(WindowRefiner&&) noexcept;
  WindowRefiner& operator=(WindowRefiner&&) noexcept;

  /// @throws std::invalid_argument on invalid options or an index out of range
  [[nodiscard]] WindowRefineResult refine(SlidingWindow& window,
                                          const WindowRefineOptions& options);

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

/// Least squares for the gradients of all patches from the affinities of their observations, and
/// the flags affine_consistent. Linear, closed form. Returns the number of consistent observations.
std::size_t fit_patches(SlidingWindow& window, const WindowRefineOptions& options);

/// Information (inverse covariance) of the pose of one view, R ← exp([w]×) R, t ← t + v, given the
/// other views, landmark depths marginalised: what the images say about the view.
[[nodiscard]] Eigen::Matrix<double, 6, 6> view_information(const SlidingWindow& window,
                                                           std::size_t view,
                                                           const WindowRefineOptions& options);

}  // namespace oneac
