#include "import/bag/stray_stamps.h"

#include "oneac/base/median.h"

#include <algorithm>
#include <cmath>

namespace oneac {
namespace {

constexpr double kMostLate_s = 10.0;    // drivers and networks hold an image for seconds at most
constexpr std::size_t kNeighbours = 3;  // on each side: two stray ones are fewer than the others

/// Median of a quantity over the messages from one place to before another.
template <class Quantity>
double median_of(const std::vector<MessageTime>& times, std::size_t from, std::size_t to,
                 const Quantity& quantity) {
  std::vector<double> values;
  for (std::size_t i = from; i < to; ++i) values.push_back(quantity(times[i]));
  return upper_median(std::move(values));
}

}  // namespace

std::vector<StrayStamp> stray_stamps(const std::vector<MessageTime>& times) {
  constexpr std::size_t kFewest = 4;  // to tell who of them is wrong
  std::vector<StrayStamp> strays;
  if (times.size() < kFewest) return strays;
  const auto stamp = [](const MessageTime& time) { return time.stamp_s; };
  const auto ahead = [](const MessageTime& time) { return time.stamp_s - time.received_s; };
  for (std::size_t i = 0; i < times.size(); ++i) {
    const std::size_t from = i - std::min(i, kNeighbours);
    const std::size_t to = std::min(times.size(), i + 1 + kNeighbours);
    // With its own: where a clock steps, the messages of either side are the more by one.
    const double off_s = ahead(times[i]) - median_of(times, from, to, ahead);
    if (std::abs(off_s) <= kMostLate_s) continue;
    const bool at_an_end = i == 0 || i + 1 == times.size();
    if (!at_an_end && times[i].stamp_s >= median_of(times, from, i, stamp) &&
        times[i].stamp_s <= median_of(times, i + 1, to, stamp)) {
      continue;
    }
    strays.push_back({i, off_s});
  }
  return strays;
}

}  // namespace oneac
