#include "oneac/robust/pitch_sweep.h"

#include <cmath>

namespace oneac {

std::vector<double> pitch_sweep(double range, double step) {
  std::vector<double> pitches{0.0};
  if (!(step > 0.0)) return pitches;
  const int count = static_cast<int>(std::floor(range / step + 1e-9));
  for (int i = 1; i <= count; ++i) {
    pitches.push_back(i * step);
    pitches.push_back(-i * step);
  }
  return pitches;
}

}  // namespace oneac
