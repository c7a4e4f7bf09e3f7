#include "planar_forms.h"

#include <algorithm>
#include <array>

namespace oneac::python {
namespace {

/// A block of correspondences turned into one array per number.
class Block {
 public:
  AcArrays take(const AcInput& acs, std::size_t first, std::size_t count) {
    acs.require_finite(first, count);
    split<2>(acs.x1() + 2 * first, count, 0);
    split<2>(acs.x2() + 2 * first, count, 2);
    split<4>(acs.A() + 4 * first, count, 4);
    const auto column = [this](std::size_t k) { return columns_[k].data(); };
    return {column(0), column(1), column(2), column(3), column(4),
            column(5), column(6), column(7), count};
  }

 private:
  template <std::size_t kWidth>
  void split(const double* rows, std::size_t count, std::size_t first_column) {
    for (std::size_t k = 0; k < kWidth; ++k) {
      double* column = columns_[first_column + k].data();
      for (std::size_t i = 0; i < count; ++i) column[i] = rows[kWidth * i + k];
    }
  }

  std::array<std::array<double, kBlock>, 8> columns_;
};

PlanarPoseArrays from(const PlanarPoseArrays& poses, std::size_t first) {
  return {poses.cos_alpha + first, poses.sin_alpha + first, poses.tx + first, poses.tz + first,
          poses.valid + first};
}

void put(const PlanarPoseSet& found, const PlanarPoseArrays& poses, std::size_t i) {
  const PlanarPose pose = found.empty() ? PlanarPose{} : found[0];
  poses.cos_alpha[i] = pose.cos_alpha;
  poses.sin_alpha[i] = pose.sin_alpha;
  poses.tx[i] = pose.tx;
  poses.tz[i] = pose.tz;
  poses.valid[i] = static_cast<std::uint8_t>(!found.empty());
}

void solve_one_by_one(const Solver& solver, const AcInput& acs, const PlanarPoseArrays& poses) {
  std::array<AffineCorrespondence, kBlock> block;
  for (std::size_t first = 0; first < acs.size(); first += kBlock) {
    const std::size_t count = std::min(kBlock, acs.size() - first);
    acs.require_finite(first, count);
    acs.load(first, count, block.data());
    for (std::size_t i = 0; i < count; ++i) put(solver.run.planar(block[i]), poses, first + i);
  }
}

/// Calls `solve(first, correspondences)` for each block.
template <class Solve>
void for_each_block(const AcInput& acs, Solve&& solve) {
  Block block;
  for (std::size_t first = 0; first < acs.size(); first += kBlock) {
    solve(first, block.take(acs, first, std::min(kBlock, acs.size() - first)));
  }
}

}  // namespace

bool has_planar(const Solver& solver) {
  return solver.run.planar != nullptr && solver.run.max_candidates == 1;
}

void solve_planar(const Solver& solver, const AcInput& acs, const PlanarPoseArrays& poses) {
  if (solver.batch == nullptr || acs.A() == nullptr) {
    solve_one_by_one(solver, acs, poses);
    return;
  }
  for_each_block(acs, [&](std::size_t first, const AcArrays& block) {
    solver.batch(block, from(poses, first), best_simd_level());
  });
}

void solve_in_blocks(const Solver& solver, const AcInput& acs, const TakeBlock& take) {
  std::array<std::array<double, kBlock>, 4> numbers;
  std::array<std::uint8_t, kBlock> valid;
  const PlanarPoseArrays poses{numbers[0].data(), numbers[1].data(), numbers[2].data(),
                               numbers[3].data(), valid.data()};
  for_each_block(acs, [&](std::size_t first, const AcArrays& block) {
    solver.batch(block, poses, best_simd_level());
    take(first, block.size, poses);
  });
}

}  // namespace oneac::python
