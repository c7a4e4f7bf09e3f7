#include "oneac/robust/point_set.h"

#include "consensus/consensus_kernels.h"
#include "polish/point_arrays.h"

#include <algorithm>
#include <cmath>

namespace oneac {
namespace {

// Groups scored between two looks at `give_up`: long enough for the vector units, short enough to
// drop a bad hypothesis after a fraction of the points.
constexpr std::size_t kBlock = 4;

}  // namespace

template <class Number>
BasicPointSet<Number>::BasicPointSet(AcSpan acs) : count(acs.size()) {
  const std::size_t padded =
      (count + internal::kPointGroup - 1) / internal::kPointGroup * internal::kPointGroup;
  for (std::vector<Number>* v : {&x1, &y1, &x2, &y2, &weight}) v->assign(padded, Number{0});
  for (std::size_t i = 0; i < count; ++i) {
    x1[i] = static_cast<Number>(acs[i].x1.x());
    y1[i] = static_cast<Number>(acs[i].x1.y());
    x2[i] = static_cast<Number>(acs[i].x2.x());
    y2[i] = static_cast<Number>(acs[i].x2.y());
    weight[i] = Number{1};
  }
}
template struct BasicPointSet<float>;
template struct BasicPointSet<double>;

double msac_cost(const Eigen::Matrix3d& E, const PointSet& points, double threshold,
                 double give_up) {
  float entries[9];
  for (int i = 0; i < 9; ++i) entries[i] = static_cast<float>(E(i / 3, i % 3));
  const auto inverse_squared = static_cast<float>(1.0 / (threshold * threshold));
  const internal::PointArrays<float> arrays = internal::arrays_of(points);
  const std::size_t groups = arrays.padded_size / internal::kPointGroup;
  const auto& kernels = internal::simd_kernels<internal::ConsensusKernels>();
  double cost = 0.0;
  for (std::size_t first = 0; first < groups && cost < give_up; first += kBlock) {
    const std::size_t last = std::min(first + kBlock, groups);
    cost += static_cast<double>(kernels.msac(entries, arrays, first, last, inverse_squared));
  }
  return cost;
}

}  // namespace oneac
