#include "oneac/base/bound.h"

#include <locale>
#include <sstream>

namespace oneac {
namespace {

std::string number(double value) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << value;
  return text.str();
}

/// Takes the first of "one, two or three" off the list.
std::string_view take_name(std::string_view& names) {
  constexpr std::string_view kComma = ", ", kOr = " or ";
  const std::size_t comma = names.find(kComma), last = names.find(kOr);
  const std::size_t end = comma < last ? comma : last;
  const std::string_view name = names.substr(0, end);
  const std::size_t gap = comma < last ? kComma.size() : kOr.size();
  names.remove_prefix(end == std::string_view::npos ? names.size() : end + gap);
  return name;
}

}  // namespace

bool Bound::holds(double value) const {
  if (any_) return true;
  return (open_below_ ? value > least_ : value >= least_) &&
         (open_above_ ? value < most_ : value <= most_);
}

bool Bound::holds(std::string_view name) const {
  if (names_.empty()) return true;
  for (std::string_view rest = names_; !rest.empty();) {
    if (take_name(rest) == name) return true;
  }
  return false;
}

std::string Bound::text() const {
  if (!names_.empty()) return std::string(names_);
  if (any_) return "";
  if (most_ < kInfinity) {
    const std::string least = number(least_), most = number(most_);
    if (open_above_) return "between " + least + " and " + most;
    return open_below_ ? "above " + least + ", at most " + most : "from " + least + " to " + most;
  }
  const std::string finite = open_above_ ? " and finite" : "";
  return (open_below_ ? std::string("positive") : "at least " + number(least_)) + finite;
}

}  // namespace oneac
