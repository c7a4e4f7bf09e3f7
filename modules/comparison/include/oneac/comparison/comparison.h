#pragma once

#include "oneac/comparison/journal.h"
#include "oneac/comparison/pair_record.h"
#include "oneac/comparison/settings.h"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace oneac {

/// How to run; changes no result.
struct CompareHooks {
  int threads = 1;  ///< pairs at once; each pair is estimated by one thread
  std::function<bool()> keep_going = [] { return true; };
  std::function<void(double share, std::size_t pairs)> progress = [](double, std::size_t) {};
  /// One line to be told to the user, of a log that can be used.
  std::function<void(const std::string&)> note = [](const std::string&) {};
};

/// Runs what the journal does not hold yet: each pair's correspondences are extracted once and
/// given to every method, with the same levelling. Every pair is in the journal before the next.
/// Images that repeat the one before are left out, and said, as `oneac run` does: no method can
/// tell a motion from two prints of one image, and the reference has one.
///
/// Levelling: the log's tilt (or that of the settings), its pitch corrected by the median elevation
/// of the direction of travel that "1ac_pooled" finds on up to kTiltPairs pairs spread evenly over
/// the log; it depends neither on the shard nor on the methods compared.
///
/// @return one line per log that ends in damage or at an image that cannot be decoded, to be told
/// to the user
/// @throws InputError when a log cannot be used
std::vector<std::string> run_comparison(const CompareSettings& settings, const Shard& shard,
                                        Journal& journal, const CompareHooks& hooks);

/// Enough for the median's error (1.25 σ / √n of about 0.5°) to be below 0.1°.
inline constexpr std::size_t kTiltPairs = 48;

}  // namespace oneac
