#include "consensus/pose_search.h"

#include "consensus/consensus_kernels.h"
#include "consensus/levelled_acs.h"

#include "oneac/geometry/angles.h"
#include "oneac/robust/pitch_sweep.h"
#include "oneac/solvers/registry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace oneac::internal {
namespace {

// Points of the first score: with 80 % outliers still a dozen that the true motion explains.
constexpr std::size_t kSample = 64;
// Width of the first score against the threshold: half a step of the sweep moves the points by
// about two pixels.
constexpr double kSampleWidth = 2.0;
// Translations [plane distances] whose squares are normal numbers in single precision, and whose
// gradients are far above the kernels' smallest: others are no vehicle's.
constexpr double kShortest = 1e-9;
constexpr double kLongest = 1e9;

/// Planar motions of any length at one relative turn of the second view, with room for whole groups
/// of lanes. Their essential matrices are scored by ratios in which the length cancels.
class PlanarPool {
 public:
  void clear() { size_ = 0; }
  [[nodiscard]] std::size_t size() const { return size_; }

  void add(double cos_alpha, double sin_alpha, double tx, double tz) {
    const double squared = tx * tx + tz * tz;
    if (!(squared > kShortest * kShortest && squared < kLongest * kLongest)) return;
    if (size_ >= motions_.size()) grow();
    motions_[size_] = {cos_alpha, sin_alpha, tx, tz};
    e12_[size_] = static_cast<float>(-tz);
    e21_[size_] = static_cast<float>(tz * cos_alpha - tx * sin_alpha);
    e23_[size_] = static_cast<float>(-tz * sin_alpha - tx * cos_alpha);
    e32_[size_] = static_cast<float>(tx);
    ++size_;
  }

  /// What lies behind size() up to the padding is scored for nothing.
  [[nodiscard]] PlanarEssentials essentials() const {
    return {e12_.data(), e21_.data(), e23_.data(), e32_.data(),
            (size_ + kPointGroup - 1) / kPointGroup * kPointGroup};
  }
  [[nodiscard]] const std::array<double, 4>& motion(std::size_t i) const { return motions_[i]; }

 private:
  void grow() {
    const std::size_t room = 2 * motions_.size() + 16 * kPointGroup;
    motions_.resize(room);
    for (std::vector<float>* e : {&e12_, &e21_, &e23_, &e32_}) e->resize(room, 0.0F);
  }

  std::size_t size_ = 0;
  std::vector<std::array<double, 4>> motions_;  ///< cos α, sin α, t_x, t_z
  std::vector<float> e12_, e21_, e23_, e32_;
};

/// The output arrays of a batch solver.
struct BatchPoses {
  std::vector<double> cos_alpha, sin_alpha, tx, tz;
  std::vector<std::uint8_t> valid;

  void resize(std::size_t size) {
    for (std::vector<double>* v : {&cos_alpha, &sin_alpha, &tx, &tz}) v->resize(size);
    valid.resize(size);
  }
  [[nodiscard]] PlanarPoseArrays arrays() {
    return {cos_alpha.data(), sin_alpha.data(), tx.data(), tz.data(), valid.data()};
  }
  void move_to(PlanarPool& pool) const {
    for (std::size_t i = 0; i < valid.size(); ++i) {
      if (valid[i] != 0) pool.add(cos_alpha[i], sin_alpha[i], tx[i], tz[i]);
    }
  }
};

/// The solvers of the pool that are on, those for any scene first: of two hypotheses of equal cost
/// the one that assumes less is kept.
struct Chosen {
  std::vector<BatchSolver> batch;
  std::vector<decltype(SolverFunctions::planar)> one_by_one;

  explicit Chosen(const SolverPool& pool) {
    for (const bool any_scene : {true, false}) {
      for (std::size_t i = 0; i < pool_solvers().size(); ++i) {
        const Solver* solver = pool_solvers()[i];
        if (!pool.on[i] || (solver->surface == SolverSurface::kAny) != any_scene) continue;
        if (solver->batch != nullptr) {
          batch.push_back(solver->batch);
        } else {
          one_by_one.push_back(solver->run.planar);
        }
      }
    }
  }
};

/// The share of the correspondences with every chosen solver. @return minimal problems solved
std::size_t solve(const LevelledAcs& acs, const Chosen& chosen, BatchPoses& poses,
                  PlanarPool& pool) {
  const AcArrays arrays = acs.arrays();
  poses.resize(arrays.size);
  for (const BatchSolver batch : chosen.batch) {
    batch(arrays, poses.arrays(), best_simd_level());
    poses.move_to(pool);
  }
  for (std::size_t i = 0; i < arrays.size && !chosen.one_by_one.empty(); ++i) {
    const AffineCorrespondence ac = acs.at(i);
    for (const auto planar : chosen.one_by_one) {
      for (const PlanarPose& s : planar(ac)) pool.add(s.cos_alpha, s.sin_alpha, s.tx, s.tz);
    }
  }
  return arrays.size * (chosen.batch.size() + chosen.one_by_one.size());
}

/// So that about `problems` are solved per solver over all turns, every correspondence at some of
/// them.
std::size_t stride_for(std::size_t acs, std::size_t turns, int problems) {
  const auto wanted = static_cast<std::size_t>(problems);
  return std::max<std::size_t>(1, (acs * turns + wanted / 2) / wanted);
}

/// One scored motion, small: poses are made of those that stay.
struct Entry {
  float cost;
  std::uint32_t order;  ///< of arrival, which decides between equals
  std::uint32_t turn;   ///< index of the relative pitch and roll
  std::array<double, 4> motion;
};

bool better(const Entry& a, const Entry& b) {
  return a.cost != b.cost ? a.cost < b.cost : a.order < b.order;
}

/// Keeps the best entries seen.
class ShortList {
 public:
  explicit ShortList(std::size_t keep) : keep_(keep) { entries_.reserve(4 * keep); }

  void offer(const Entry& entry) {
    if (!(entry.cost < bar_)) return;
    entries_.push_back(entry);
    if (entries_.size() >= 4 * keep_) shrink();
  }
  [[nodiscard]] const std::vector<Entry>& sorted() {
    if (entries_.size() > keep_) shrink();
    std::sort(entries_.begin(), entries_.end(), better);
    return entries_;
  }

 private:
  void shrink() {
    const auto last = entries_.begin() + static_cast<std::ptrdiff_t>(keep_ - 1);
    std::nth_element(entries_.begin(), last, entries_.end(), better);
    bar_ = last->cost;
    entries_.resize(keep_);
  }

  std::size_t keep_;
  float bar_ = std::numeric_limits<float>::infinity();
  std::vector<Entry> entries_;
};

/// The turns of the second view: every pitch with every roll.
std::vector<Eigen::Matrix3d> turns(const ConsensusOptions& options) {
  std::vector<Eigen::Matrix3d> Q;
  for (double roll :
       pitch_sweep(options.roll_sweep_deg * kDegree, options.roll_step_deg * kDegree)) {
    for (double pitch :
         pitch_sweep(options.pitch_sweep_deg * kDegree, options.pitch_step_deg * kDegree)) {
      Q.push_back(roll_rotation(roll) * pitch_rotation(pitch));
    }
  }
  return Q;
}

/// What a search looks at beside the correspondences.
struct Scope {
  std::vector<Eigen::Matrix3d> turns;  ///< of the second view
  int problems;                        ///< minimal ones, per solver
  std::size_t keep;
};

SearchResult search(AcSpan acs, const Eigen::Matrix3d& R_level_cam, double threshold,
                    const Scope& scope, const ConsensusOptions& options) {
  SearchResult result;
  LevelledAcs levelled(acs, R_level_cam);
  if (levelled.size() == 0) return result;
  const ConsensusKernels& kernels = simd_kernels<ConsensusKernels>();
  const double width = kSampleWidth * threshold;
  const auto inverse_squared = static_cast<float>(1.0 / (width * width));
  const std::vector<Eigen::Matrix3d>& Q = scope.turns;
  const std::size_t stride = stride_for(levelled.size(), Q.size(), scope.problems);
  const Chosen chosen(options.pool);
  BatchPoses poses;
  PlanarPool pool;
  ShortList list(scope.keep);
  std::vector<float> costs;
  for (std::size_t turn = 0; turn < Q.size(); ++turn) {
    levelled.turn_second_view(Q[turn], {turn % stride, stride});
    pool.clear();
    result.solved += solve(levelled, chosen, poses, pool);
    costs.resize(pool.essentials().padded_size);
    kernels.planar_costs(pool.essentials(), levelled.sample(kSample, Q[turn]), inverse_squared,
                         costs.data());
    for (std::size_t i = 0; i < pool.size(); ++i) {
      const auto order = static_cast<std::uint32_t>(result.hypotheses + i);
      list.offer({costs[i], order, static_cast<std::uint32_t>(turn), pool.motion(i)});
    }
    result.hypotheses += pool.size();
  }
  for (const Entry& entry : list.sorted()) {
    const Eigen::Matrix3d Q2t = (Q[entry.turn] * R_level_cam).transpose();
    const auto& [c, s, tx, tz] = entry.motion;
    result.best.push_back(
        {{Q2t * yaw_rotation(c, s) * R_level_cam, Q2t * Eigen::Vector3d(tx, 0.0, tz).normalized()},
         static_cast<double>(entry.cost)});
  }
  return result;
}

}  // namespace

SearchResult search_poses(AcSpan acs, const Eigen::Matrix3d& R_level_cam, double threshold,
                          std::size_t keep, const ConsensusOptions& options) {
  return search(acs, R_level_cam, threshold, {turns(options), options.minimal_problems, keep},
                options);
}

SearchResult search_level_poses(AcSpan acs, const Eigen::Matrix3d& R_level_cam, double threshold,
                                std::size_t keep, const ConsensusOptions& options) {
  const std::size_t stride = stride_for(acs.size(), 1, options.first_problems);
  std::vector<AffineCorrespondence> some;
  some.reserve(acs.size() / stride + 1);
  for (std::size_t i = 0; i < acs.size(); i += stride) some.push_back(acs[i]);
  return search(some, R_level_cam, threshold,
                {{Eigen::Matrix3d::Identity()}, options.first_problems, keep}, options);
}

}  // namespace oneac::internal
