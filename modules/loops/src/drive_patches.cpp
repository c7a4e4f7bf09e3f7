#include "drive_patches.h"

#include "oneac/geometry/relative_pose.h"
#include "oneac/refine/sliding_window.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

namespace oneac::internal {
namespace {

constexpr double kBehind = 1e-2;  // [-] of the anchor's depth: nearer to the camera than any lens
constexpr int kRounds = 5;        // of the depth, under Cauchy's weights

RelativePose view_of_anchor(const Poses& poses, std::size_t view, std::size_t anchor) {
  const Eigen::Isometry3d T = poses[view].inverse() * poses[anchor];
  return {T.linear(), T.translation()};
}

/// A sighting's say in the inverse depth: (turned + ρ t) × x = 0.
struct DepthTerm {
  Eigen::Vector2d a, b;
  double z, tz;  ///< of turned and t
  double sigma;

  [[nodiscard]] double depth(double rho) const { return z + rho * tz; }
  [[nodiscard]] double weight(double rho) const {
    const double scale = sigma * std::max(depth(rho), kBehind);
    const double squared = (a + rho * b).squaredNorm() / (scale * scale);
    return 1.0 / (scale * scale * (1.0 + squared));
  }
};

std::vector<DepthTerm> depth_terms(const SharedPatch& sightings, const Poses& poses) {
  std::vector<DepthTerm> terms;
  const Eigen::Vector3d ray = sightings.front().x.cast<double>().homogeneous();
  for (std::size_t i = 1; i < sightings.size(); ++i) {
    const PatchSighting& seen = sightings[i];
    const RelativePose T = view_of_anchor(poses, seen.keyframe, sightings.front().keyframe);
    const Eigen::Vector3d turned = T.R * ray;
    const Eigen::Vector2d x = seen.x.cast<double>();
    terms.push_back({turned.head<2>() - turned.z() * x, T.t.head<2>() - T.t.z() * x, turned.z(),
                     T.t.z(), static_cast<double>(seen.point_sigma)});
  }
  return terms;
}

/// Depth by least squares under Cauchy's weights. @return whether it is in front of all
bool triangulate(const Poses& poses, GlobalPatch& patch) {
  const std::vector<DepthTerm> terms = depth_terms(patch.sightings, poses);
  double rho = 0.0, information = 0.0;
  for (int round = 0; round < kRounds; ++round) {
    double vote = 0.0;
    information = 0.0;
    for (const DepthTerm& term : terms) {
      const double weight = term.weight(rho);
      information += weight * term.b.squaredNorm();
      vote -= weight * term.a.dot(term.b);
    }
    if (!(information > 0.0)) return false;
    rho = vote / information;
  }
  patch.m << patch.sightings.front().x.cast<double>(), rho;
  patch.T_frame_anchor = poses[patch.sightings.front().keyframe];
  patch.depth_information = information * rho * rho;
  return patch.m.allFinite() && std::all_of(terms.begin(), terms.end(), [&](const auto& term) {
           return term.depth(rho) > kBehind;
         });
}

void add_if_located(GlobalPatch patch, const Poses& poses, std::vector<GlobalPatch>& patches) {
  if (patch.sightings.size() > 1 && triangulate(poses, patch)) patches.push_back(std::move(patch));
}

/// Of a feature that several loops have; each keyframe once.
void merge(const SharedPatch& other, SharedPatch& patch) {
  for (const PatchSighting& seen : other) {
    const bool known = std::any_of(patch.begin(), patch.end(), [&](const PatchSighting& own) {
      return own.keyframe == seen.keyframe;
    });
    if (!known) patch.push_back(seen);
  }
}

using Order = std::vector<std::size_t>;

/// Goes through the patches in an order and takes those of a keyframe that has less than `most`.
void take(const std::vector<GlobalPatch>& patches, const Order& order, std::size_t most,
          std::vector<std::size_t>& count, std::vector<bool>& taken) {
  for (const std::size_t i : order) {
    const SharedPatch& seen = patches[i].sightings;
    const bool wanted = std::any_of(
        seen.begin(), seen.end(), [&](const PatchSighting& s) { return count[s.keyframe] < most; });
    if (taken[i] || !wanted) continue;
    taken[i] = true;
    for (const PatchSighting& s : seen) ++count[s.keyframe];
  }
}

template <class Less>
Order sorted(std::size_t size, Less&& before) {
  Order order(size);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), std::forward<Less>(before));
  return order;
}

SlidingWindow window_of(const Poses& poses, const std::vector<GlobalPatch>& patches) {
  SlidingWindow window;
  for (const Eigen::Isometry3d& T : poses) {
    const Eigen::Isometry3d inverse = T.inverse();
    window.views.push_back({{inverse.linear(), inverse.translation()}, true});
  }
  for (const GlobalPatch& patch : patches) {
    WindowLandmark landmark;
    landmark.anchor = patch.sightings.front().keyframe;
    landmark.x = patch.m.head<2>();
    landmark.inverse_depth = patch.m.z();
    window.landmarks.push_back(landmark);
    for (const PatchSighting& s : patch.sightings) {
      window.observations.push_back({window.landmarks.size() - 1, s.keyframe, s.x.cast<double>(),
                                     s.A.cast<double>(), s.point_sigma, s.affine_sigma, false});
    }
  }
  return window;
}

}  // namespace

std::vector<GlobalPatch> patches_of_tracks(const DrivePatches& drive, const Poses& poses) {
  std::vector<GlobalPatch> patches;
  for (std::size_t i = 0; i < drive.patches.size(); ++i) {
    GlobalPatch patch;
    patch.track = i;
    patch.sightings = drive.patches[i];
    add_if_located(std::move(patch), poses, patches);
  }
  return patches;
}

std::vector<GlobalPatch> patches_of_loops(const std::vector<LoopConstraint>& loops,
                                          const Poses& poses) {
  std::map<std::tuple<std::uint32_t, float, float>, SharedPatch> features;
  for (const LoopConstraint& loop : loops) {
    for (const SharedPatch& patch : loop.patches) {
      if (patch.empty()) continue;
      const PatchSighting& own = patch.front();
      merge(patch, features[{own.keyframe, own.x.x(), own.x.y()}]);
    }
  }
  std::vector<GlobalPatch> patches;
  for (auto& [feature, sightings] : features) {
    GlobalPatch patch;
    patch.sightings = std::move(sightings);
    add_if_located(std::move(patch), poses, patches);
  }
  return patches;
}

std::vector<GlobalPatch> chosen(std::vector<GlobalPatch> patches, std::size_t keyframes,
                                std::size_t most) {
  const Order longest = sorted(patches.size(), [&](std::size_t a, std::size_t b) {
    return patches[a].sightings.size() > patches[b].sightings.size();
  });
  const Order nearest = sorted(patches.size(), [&](std::size_t a, std::size_t b) {
    return patches[a].depth_information > patches[b].depth_information;
  });
  std::vector<std::size_t> count(keyframes, 0);
  std::vector<bool> taken(patches.size(), false);
  take(patches, longest, most / 2, count, taken);
  take(patches, nearest, most, count, taken);
  std::vector<GlobalPatch> kept;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    if (taken[i]) kept.push_back(std::move(patches[i]));
  }
  return kept;
}

std::size_t observations_of(const std::vector<GlobalPatch>& patches) {
  return std::accumulate(
      patches.begin(), patches.end(), std::size_t{0},
      [](std::size_t sum, const GlobalPatch& patch) { return sum + patch.sightings.size(); });
}

std::size_t keep_affine_consistent(const Poses& poses, std::vector<GlobalPatch>& patches) {
  SlidingWindow window = window_of(poses, patches);
  static_cast<void>(fit_patches(window, {}));
  std::size_t at = 0, left_out = 0;
  for (GlobalPatch& patch : patches) {
    SharedPatch kept{patch.sightings.front()};
    for (std::size_t i = 0; i < patch.sightings.size(); ++i, ++at) {
      if (window.observations[at].affine_consistent) kept.push_back(patch.sightings[i]);
    }
    left_out += patch.sightings.size() - kept.size();
    patch.sightings = std::move(kept);
  }
  const auto alone = [](const GlobalPatch& patch) { return patch.sightings.size() < 2; };
  patches.erase(std::remove_if(patches.begin(), patches.end(), alone), patches.end());
  return left_out;
}

}  // namespace oneac::internal
