#include "read/name_order.h"

#include <algorithm>
#include <filesystem>
#include <utility>

namespace oneac {
namespace {

constexpr std::size_t kFewestFalls = 2;
constexpr std::size_t kOneOf =
    50;  // falls in so many images: every tenth of 1, 10, 11 … 2, 20 falls

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// The last number of a stem, without zeros in front; empty where there is none, and for the
/// decimals of a number.
std::string number_of(const std::string& stem) {
  const auto last = std::find_if(stem.rbegin(), stem.rend(), is_digit);
  const auto before = std::find_if_not(last, stem.rend(), is_digit);
  if (last == stem.rend() || (before != stem.rend() && *before == '.')) return {};
  const std::string digits(before.base(), last.base());
  return digits.substr(std::min(digits.find_first_not_of('0'), digits.size() - 1));
}

bool is_smaller(const std::string& a, const std::string& b) {
  return a.size() != b.size() ? a.size() < b.size() : a < b;
}

}  // namespace

void NameOrder::add(const std::string& file) {
  const std::filesystem::path path(file);
  Numbered now{path.filename().string(), number_of(path.stem().string())};
  if (now.digits.empty()) return;
  ++numbered_;
  if (last_ && is_smaller(now.digits, last_->digits) && falls_++ == 0) {
    first_fall_ = last_->name + ", then " + now.name;
  }
  last_ = std::move(now);
}

std::string NameOrder::fault() const {
  if (falls_ < kFewestFalls || falls_ * kOneOf < numbered_) return {};
  return "the numbers in the names of the images fall " + std::to_string(falls_) +
         " times while time goes on (first: " + first_fall_ +
         "), so nothing is in metres; write the log with the images in the order of their numbers";
}

}  // namespace oneac
