#include "verification.h"

#include "oneac/geometry/angles.h"
#include "oneac/geometry/essential.h"
#include "oneac/refine/two_view.h"
#include "oneac/robust/one_ac_consensus.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <set>

namespace oneac::internal {
namespace {

// [px] 1σ of a feature's place against the poses of neighbours, which the window has adjusted.
constexpr double kNeighbourNoise_px = 0.5;
constexpr double kGate = 3.0;           // [σ]
constexpr std::size_t kFewestAcs = 15;  // what the consensus asks for
// Two lanes, two springs: a loop may be as far from planar as the sweep covers, and farther apart
// than steps of a drive are.
constexpr double kThreshold_px = 2.0;

FeatureOptions feature_options(const LoopOptions& loops, const LoopCamera& camera) {
  FeatureOptions options;
  options.vlfeat.max_features = loops.features;
  options.mask.polygon = camera.mask_polygon;
  options.mask.image = camera.mask_image;
  return options;
}

std::pair<double, double> key_of(const Eigen::Vector2d& u) {
  return {u.x(), u.y()};
}

/// The inverse depth at which the other view shows the point, by least squares in its image.
struct DepthFit {
  double inverse_depth = 0.0, sigma = 0.0;
  double misfit = 0.0;  ///< [-] what no depth explains
};
std::optional<DepthFit> fit_depth(const AffineCorrespondence& ac, const RelativePose& T,
                                  double noise) {
  const Eigen::Vector3d turned = T.R * ac.x1.homogeneous();
  // (turned + ρ t) × x2 = 0, linear in ρ; divided by the depth it is a distance in the image.
  Eigen::Vector2d a = turned.head<2>() - turned.z() * ac.x2;
  Eigen::Vector2d b = T.t.head<2>() - T.t.z() * ac.x2;
  const double squared = b.squaredNorm();
  if (!(squared > 0.0)) return std::nullopt;
  DepthFit fit;
  fit.inverse_depth = -a.dot(b) / squared;
  const double depth = turned.z() + fit.inverse_depth * T.t.z();
  if (!(depth > 0.0)) return std::nullopt;
  fit.sigma = noise * depth / std::sqrt(squared);
  fit.misfit = (a + fit.inverse_depth * b).norm() / depth;
  return fit;
}

/// Both measurements where they agree; the better one is not known where they do not.
bool join(const DepthFit& fit, FeatureDepth& depth) {
  const double difference = fit.inverse_depth - depth.inverse_depth;
  const double variance = fit.sigma * fit.sigma + depth.sigma * depth.sigma;
  if (difference * difference > kGate * kGate * variance) return false;
  const double w1 = 1.0 / (depth.sigma * depth.sigma), w2 = 1.0 / (fit.sigma * fit.sigma);
  depth.inverse_depth = (w1 * depth.inverse_depth + w2 * fit.inverse_depth) / (w1 + w2);
  depth.sigma = std::sqrt(1.0 / (w1 + w2));
  return true;
}

/// Sights of the correspondences that have a landmark on a side, and which correspondence each is
/// of.
struct Sights {
  std::vector<LandmarkSight> sights;
  std::vector<std::size_t> acs;
};

class SightMaker {
 public:
  SightMaker(const PinholeCamera& camera, const FeatureDepths& first, const FeatureDepths& second)
      : camera_(camera), first_(first), second_(second) {}

  void add(const Correspondence& pair, std::size_t ac, Sights& out) const {
    const Eigen::Vector2d feature2 = pair.x2 - pair.moved;
    if (const auto at = first_.find(key_of(pair.x1)); at != first_.end()) {
      add(at->second, pair.x1, pair.x2, true, ac, out);
    }
    if (const auto at = second_.find(key_of(feature2)); at != second_.end()) {
      // The feature itself, and where the affinity sees it in the first image.
      const Eigen::Vector2d u1 = pair.x1 - pair.A.inverse() * pair.moved;
      add(at->second, feature2, u1, false, ac, out);
    }
  }

 private:
  void add(const FeatureDepth& depth, const Eigen::Vector2d& u, const Eigen::Vector2d& other,
           bool of_first, std::size_t ac, Sights& out) const {
    out.sights.push_back({camera_.normalise(u), depth.inverse_depth, depth.sigma,
                          camera_.normalise(other), of_first});
    out.acs.push_back(ac);
  }

  const PinholeCamera& camera_;
  const FeatureDepths& first_;
  const FeatureDepths& second_;
};

/// Inliers whose affinity obeys the epipolar geometry, too, as those of the window do; all of them
/// where the camera did not travel, which constrains no affinity.
std::vector<bool> affine_consistent(const std::vector<AffineCorrespondence>& acs,
                                    const RobustResult& found, double focal_px) {
  if (!has_direction(found.status)) return found.inliers;
  const RefineResult refined = refine_two_view(acs, found.inliers, found.pose, focal_px, {});
  return refined.usable() ? refined.affine_consistent : found.inliers;
}

/// Correspondences with a landmark that obeys the pose.
std::set<std::size_t> inliers_of(const LandmarkPose& pose, const std::vector<std::size_t>& acs) {
  std::set<std::size_t> inliers;
  for (std::size_t i = 0; i < acs.size(); ++i) {
    if (pose.inliers[i]) inliers.insert(acs[i]);
  }
  return inliers;
}

double largest_sigma(const Eigen::Matrix3d& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance, Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(solver.eigenvalues().maxCoeff(), 0.0));
}

/// 1σ along t; of the position where t is shorter than that.
double sigma_of_length(const Eigen::Vector3d& t, const Eigen::Matrix3d& covariance) {
  const double all = largest_sigma(covariance);
  const double length = t.norm();
  if (!(length > all)) return all;
  return std::sqrt(std::max(t.dot(covariance * t), 0.0)) / length;
}

}  // namespace

Verification::Verification(const LoopOptions& options, const LoopCamera& camera)
    : options_(options),
      camera_(camera.camera),
      R_level_cam_(camera.R_level_cam),
      pairs_(feature_options(options, camera), camera.unused) {}

void Verification::add_depths(const View& view, const View& other, const RelativePose& T_2_1,
                              FeatureDepths& depths) const {
  const double noise = kNeighbourNoise_px / camera_.focal_px();
  for (const Correspondence& pair :
       pairs_.match(view.features, other.features, view.image.view(), other.image.view())) {
    const auto fit = fit_depth(normalise(pair, camera_, camera_), T_2_1, noise);
    if (!fit || fit->misfit > kGate * noise || fit->inverse_depth < -kGate * fit->sigma) continue;
    const FeatureDepth measured{fit->inverse_depth, fit->sigma, {}};
    const auto [at, fresh] = depths.try_emplace(key_of(pair.x1), measured);
    if (!fresh && !join(*fit, at->second)) {
      depths.erase(at);
    } else if (options_.keep_patches) {
      at->second.sightings.push_back(sighting(other.keyframe, pair, kNeighbourNoise_px));
    }
  }
}

std::optional<LoopConstraint> Verification::verify(const View& first, const FeatureDepths& depths1,
                                                   const View& second,
                                                   const FeatureDepths& depths2) const {
  const std::vector<Correspondence> pairs =
      pairs_.match(first.features, second.features, first.image.view(), second.image.view());
  if (pairs.size() < kFewestAcs) return std::nullopt;
  std::vector<AffineCorrespondence> acs;
  for (const Correspondence& pair : pairs) acs.push_back(normalise(pair, camera_, camera_));
  ConsensusOptions consensus;
  consensus.threshold_px = kThreshold_px;
  consensus.settled_cost *= 1.0 / (kThreshold_px * kThreshold_px);
  const RobustResult found = one_ac_consensus(acs, R_level_cam_, camera_.focal_px(), consensus);
  if (found.status == PoseStatus::kTooFew) return std::nullopt;
  const std::vector<bool> consistent = affine_consistent(acs, found, camera_.focal_px());
  Sights sights;
  const SightMaker maker(camera_, depths1, depths2);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (consistent[i]) maker.add(pairs[i], i, sights);
  }
  const double noise = options_.noise_px / camera_.focal_px();
  RelativePose start{found.pose.R, Eigen::Vector3d::Zero()};
  LandmarkPose best = pose_by_landmarks(sights.sights, start, noise);
  if (has_direction(found.status)) {
    start.t = length_by_landmarks(sights.sights, found.pose) * found.pose.t;
    LandmarkPose other = pose_by_landmarks(sights.sights, start, noise);
    if (other.usable && (!best.usable || other.cost < best.cost)) best = std::move(other);
  }
  auto loop = accepted(best, sights.acs);
  if (!loop) return loop;
  loop->acs = pairs.size();
  if (!options_.keep_patches) return loop;
  for (const std::size_t i : inliers_of(best, sights.acs)) {
    loop->patches.push_back(patch_of(pairs[i], first, depths1, second, depths2));
  }
  return loop;
}

PatchSighting Verification::sighting(std::size_t keyframe, const Correspondence& pair,
                                     double noise_px) const {
  const AffineCorrespondence ac = normalise(pair, camera_, camera_);
  PatchSighting seen;
  seen.keyframe = static_cast<std::uint32_t>(keyframe);
  seen.point_sigma = static_cast<float>(noise_px / camera_.focal_px());
  seen.affine_sigma = static_cast<float>(pair.affine_sigma);
  seen.x = ac.x2.cast<float>();
  seen.A = ac.A.cast<float>();
  return seen;
}

SharedPatch Verification::patch_of(const Correspondence& pair, const View& first,
                                   const FeatureDepths& depths1, const View& second,
                                   const FeatureDepths& depths2) const {
  Correspondence itself;
  itself.x1 = itself.x2 = pair.x1;
  itself.A.setIdentity();
  SharedPatch patch{sighting(first.keyframe, itself, kNeighbourNoise_px)};
  if (const auto at = depths1.find(key_of(pair.x1)); at != depths1.end()) {
    patch.insert(patch.end(), at->second.sightings.begin(), at->second.sightings.end());
  }
  patch.push_back(sighting(second.keyframe, pair, options_.noise_px));
  const auto at = depths2.find(key_of(pair.x2 - pair.moved));
  if (at == depths2.end()) return patch;
  // The second's own feature lies beside where the first's was found; the affinity leads over.
  const Eigen::Vector2d x2 = camera_.normalise(pair.x2);
  const Eigen::Vector2f beside = (x2 - camera_.normalise(pair.x2 - pair.moved)).cast<float>();
  const Eigen::Matrix2f A = normalise(pair, camera_, camera_).A.cast<float>();
  for (PatchSighting seen : at->second.sightings) {
    seen.x += seen.A * beside;
    seen.A *= A;
    seen.point_sigma = static_cast<float>(options_.noise_px / camera_.focal_px());
    patch.push_back(seen);
  }
  return patch;
}

std::optional<LoopConstraint> Verification::accepted(const LandmarkPose& pose,
                                                     const std::vector<std::size_t>& acs) const {
  if (!pose.usable) return std::nullopt;
  const std::set<std::size_t> with(acs.begin(), acs.end()), inliers = inliers_of(pose, acs);
  const auto side = static_cast<std::size_t>(options_.min_side_inliers);
  if (inliers.size() < static_cast<std::size_t>(options_.min_inliers) || pose.first_side < side ||
      pose.second_side < side ||
      static_cast<double>(inliers.size()) < options_.min_share * static_cast<double>(with.size())) {
    return std::nullopt;
  }
  LoopConstraint loop;
  loop.T_2_1 = pose.T_2_1;
  loop.covariance = pose.covariance;
  const Eigen::Matrix3d of_turn = loop.covariance.topLeftCorner<3, 3>();
  const Eigen::Matrix3d of_place = loop.covariance.bottomRightCorner<3, 3>();
  if (largest_sigma(of_place) > options_.max_position_m ||
      largest_sigma(of_turn) > options_.max_rotation_deg * kDegree) {
    return std::nullopt;
  }
  loop.sigma_length = sigma_of_length(loop.T_2_1.t, of_place);
  loop.inliers = inliers.size();
  return loop;
}

}  // namespace oneac::internal
