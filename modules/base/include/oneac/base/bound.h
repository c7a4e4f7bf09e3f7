#pragma once

#include <limits>
#include <string>
#include <string_view>

namespace oneac {

/// What the value of an option may be, the last column of describe(): an interval or a list of
/// names. NaN lies in no interval.
class Bound {
 public:
  /// Whatever the type holds.
  constexpr Bound() = default;
  static constexpr Bound positive() { return {0.0, kInfinity, true, false}; }
  static constexpr Bound positive_and_finite() { return {0.0, kInfinity, true, true}; }
  static constexpr Bound at_least(double least) { return {least, kInfinity, false, false}; }
  static constexpr Bound from_to(double least, double most) { return {least, most, false, false}; }
  /// Without the ends.
  static constexpr Bound between(double least, double most) { return {least, most, true, true}; }
  /// Without the lower end.
  static constexpr Bound above_to(double least, double most) { return {least, most, true, false}; }
  /// @param names  "one, two or three"; it is not copied
  static constexpr Bound one_of(std::string_view names) {
    Bound bound;
    bound.names_ = names;
    return bound;
  }

  [[nodiscard]] bool holds(double value) const;
  [[nodiscard]] bool holds(std::string_view name) const;
  /// As it stands behind "must be" and in the documentation; empty where everything may be.
  [[nodiscard]] std::string text() const;

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  constexpr Bound(double least, double most, bool open_below, bool open_above)
      : least_(least), most_(most), open_below_(open_below), open_above_(open_above), any_(false) {}

  double least_ = -kInfinity, most_ = kInfinity;
  bool open_below_ = false, open_above_ = false;
  bool any_ = true;  ///< no interval
  std::string_view names_;
};

}  // namespace oneac
