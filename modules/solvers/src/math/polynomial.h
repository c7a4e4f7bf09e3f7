#pragma once

#include <algorithm>
#include <cmath>

namespace oneac::internal {

/// Real roots of polynomials of fixed degree N by Sturm's theorem, on the stack.
///
/// Coefficients ascend: p(x) = c[0] + c[1] x + … + c[N] x^N. The roots outside [−1, 1] are found as
/// the reciprocals of the reversed polynomial's, so that all work is done on [−1, 1], where it is
/// well scaled.
template <int N>
class RealRoots {
 public:
  explicit RealRoots(const double (&c)[N + 1]) { find_all(c); }
  /// Only the roots with |x| ≤ bound (bound ≤ 1).
  RealRoots(const double (&c)[N + 1], double bound) {
    if (prepare(c, false)) isolate(-bound, bound, false);
  }

  [[nodiscard]] int size() const { return count_; }
  [[nodiscard]] double operator[](int i) const { return roots_[i]; }

 private:
  // A remainder below this share of its dividend is rounding: the chain ends in a common factor.
  static constexpr double kZeroRemainder = 1e-13;
  // Width at which roots that bisection has not separated count as one.
  static constexpr double kUnseparated = 1e-10;
  static constexpr double kRootStep = 4e-16;
  // Reciprocals below it are what vanishing leading coefficients leave: roots at infinity.
  static constexpr double kInfinite = 1e-8;

  double chain_[N + 1][N + 1] = {};
  int degree_[N + 1] = {};
  int length_ = 0;
  double roots_[N] = {};
  int count_ = 0;

  void find_all(const double (&c)[N + 1]) {
    if (prepare(c, false)) isolate(-1.0, 1.0, false);
    if (prepare(c, true)) isolate(-1.0, 1.0, true);
  }

  /// Scales the polynomial into the chain's first place; false when it is zero, constant or not
  /// finite.
  [[nodiscard]] bool prepare(const double (&c)[N + 1], bool reversed) {
    double largest = 0.0;
    for (int i = 0; i <= N; ++i) largest = std::max(largest, std::abs(c[i]));
    if (!(largest > 0.0) || !std::isfinite(largest)) return false;
    for (int i = 0; i <= N; ++i) {
      if (!std::isfinite(c[i])) return false;
      chain_[0][i] = (reversed ? c[N - i] : c[i]) / largest;
    }
    int degree = N;
    while (degree > 0 && std::abs(chain_[0][degree]) < 1e-15) --degree;
    if (degree == 0) return false;
    degree_[0] = degree;
    for (int i = 1; i <= degree; ++i) chain_[1][i - 1] = i * chain_[0][i];
    degree_[1] = degree - 1;
    length_ = 2;
    while (degree_[length_ - 1] > 0 && append_remainder()) {
    }
    return true;
  }

  /// Negated remainder of the last two, scaled by a positive number; false when it vanishes.
  [[nodiscard]] bool append_remainder() {
    const int a = length_ - 2, b = length_ - 1;
    const int da = degree_[a], db = degree_[b];
    double r[N + 1];
    for (int i = 0; i <= da; ++i) r[i] = chain_[a][i];
    const double inverse_lead = 1.0 / chain_[b][db];
    for (int k = da; k >= db; --k) {
      const double factor = r[k] * inverse_lead;
      for (int i = 0; i < db; ++i) r[k - db + i] -= factor * chain_[b][i];
    }
    double largest = 0.0;
    for (int i = 0; i < db; ++i) largest = std::max(largest, std::abs(r[i]));
    if (!(largest > kZeroRemainder)) return false;
    int degree = db - 1;
    while (degree > 0 && std::abs(r[degree]) < kZeroRemainder * largest) --degree;
    const double scale = -1.0 / largest;
    for (int i = 0; i <= degree; ++i) chain_[length_][i] = scale * r[i];
    degree_[length_++] = degree;
    return true;
  }

  [[nodiscard]] double value(int k, double x) const {
    double v = chain_[k][degree_[k]];
    for (int i = degree_[k] - 1; i >= 0; --i) v = v * x + chain_[k][i];
    return v;
  }

  [[nodiscard]] int sign_changes(double x) const {
    int changes = 0;
    bool negative = value(0, x) < 0.0;
    for (int k = 1; k < length_; ++k) {
      const bool next = value(k, x) < 0.0;
      changes += next != negative ? 1 : 0;
      negative = next;
    }
    return changes;
  }

  struct Interval {
    double low, high;
    int changes_low, changes_high;
  };

  void isolate(double low, double high, bool reversed) {
    Interval stack[2 * N + 64];
    int top = 0;
    stack[top++] = {low, high, sign_changes(low), sign_changes(high)};
    while (top > 0) {
      const Interval in = stack[--top];
      const int roots = in.changes_low - in.changes_high;
      if (roots <= 0) continue;
      if (roots == 1 && (value(0, in.low) < 0.0) != (value(0, in.high) < 0.0)) {
        add(refine(in.low, in.high), reversed);
        continue;
      }
      const double middle = 0.5 * (in.low + in.high);
      if (in.high - in.low < kUnseparated) {
        add(middle, reversed);
        continue;
      }
      const int changes = sign_changes(middle);
      if (top + 2 > 2 * N + 64) return;
      stack[top++] = {middle, in.high, changes, in.changes_high};
      stack[top++] = {in.low, middle, in.changes_low, changes};
    }
  }

  void add(double root, bool reversed) {
    if (reversed && std::abs(root) < kInfinite) return;
    if (count_ < N) roots_[count_++] = reversed ? 1.0 / root : root;
  }

  /// Newton within a bracket, bisection where it would leave it.
  [[nodiscard]] double refine(double low, double high) const {
    const bool low_negative = value(0, low) < 0.0;
    double x = 0.5 * (low + high);
    for (int step = 0; step < 60; ++step) {
      double v = chain_[0][degree_[0]], d = 0.0;
      for (int i = degree_[0] - 1; i >= 0; --i) {
        d = d * x + v;
        v = v * x + chain_[0][i];
      }
      ((v < 0.0) == low_negative ? low : high) = x;
      double next = x - v / d;
      if (!(next > low && next < high)) next = 0.5 * (low + high);
      const double change = std::abs(next - x);
      x = next;
      if (!(change > kRootStep)) break;
    }
    return x;
  }
};

}  // namespace oneac::internal
