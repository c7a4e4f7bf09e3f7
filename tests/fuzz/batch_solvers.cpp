// The batch forms on any doubles: no NaN, and a result where the scalar solver has one.
#include "correspondences.h"

#include "oneac/solvers/batch.h"
#include "oneac/solvers/relpose_1ac_ground.h"
#include "oneac/solvers/relpose_1ac_planar.h"

#include <array>

namespace {

using namespace oneac;
using Column = std::vector<double>;

struct Columns {
  std::array<Column, 8> of;

  explicit Columns(const std::vector<AffineCorrespondence>& acs) {
    for (const AffineCorrespondence& ac : acs) {
      const double values[] = {ac.x1.x(),  ac.x1.y(),  ac.x2.x(),  ac.x2.y(),
                               ac.A(0, 0), ac.A(0, 1), ac.A(1, 0), ac.A(1, 1)};
      for (std::size_t c = 0; c < of.size(); ++c) of[c].push_back(values[c]);
    }
  }
  [[nodiscard]] AcArrays arrays() const {
    return {of[0].data(), of[1].data(), of[2].data(), of[3].data(), of[4].data(),
            of[5].data(), of[6].data(), of[7].data(), of[0].size()};
  }
};

template <class Batch, class Scalar>
void compare(const std::vector<AffineCorrespondence>& acs, SimdLevel level, const Batch& batch,
             const Scalar& scalar) {
  const Columns columns(acs);
  std::array<Column, 4> poses;
  for (Column& column : poses) column.assign(acs.size(), 0.0);
  std::vector<std::uint8_t> valid(acs.size());
  const std::size_t found = batch(
      columns.arrays(),
      {poses[0].data(), poses[1].data(), poses[2].data(), poses[3].data(), valid.data()}, level);
  std::size_t expected = 0;
  for (std::size_t i = 0; i < acs.size(); ++i) {
    const bool there = !scalar(acs[i]).empty();
    expected += there ? 1 : 0;
    fuzz::check((valid[i] != 0) == there, "as empty as the scalar solver");
    const PlanarPose pose{poses[0][i], poses[1][i], poses[2][i], poses[3][i]};
    fuzz::check_pose(pose.pose());
  }
  fuzz::check(found == expected, "the number of poses");
}

}  // namespace

ONEAC_FUZZ_TARGET(batch_solvers) {
  constexpr std::size_t kMost = 19;  // two vectors of the widest level, and a rest
  fuzz::Numbers numbers(data);
  const auto acs = fuzz::correspondences(numbers, 1 + numbers.byte() % kMost);
  for (const SimdLevel level : {SimdLevel::kBaseline, SimdLevel::kAvx2, SimdLevel::kAvx512}) {
    if (!is_supported(level)) continue;
    compare(acs, level, relpose_1ac_ground_batch,
            [](const AffineCorrespondence& ac) { return relpose_1ac_ground(ac); });
    compare(acs, level, relpose_1ac_planar_batch,
            [](const AffineCorrespondence& ac) { return relpose_1ac_planar(ac); });
  }
}
