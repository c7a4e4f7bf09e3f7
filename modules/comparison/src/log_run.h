#pragma once

#include "oneac/base/ordered_pipeline.h"
#include "oneac/comparison/comparison.h"
#include "oneac/comparison/pair_stream.h"

#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace oneac::internal {

using Methods = std::vector<RelativePoseInitialiser::Ptr>;

/// Everything about one log that its pairs share.
class LogRun {
 public:
  LogRun(const CompareSettings& settings, std::size_t log, const CompareHooks& hooks);

  [[nodiscard]] const LogScan& scan() const { return scan_; }
  /// Learns the tilt and says what the reference is, or takes both from the journal. False when
  /// interrupted.
  [[nodiscard]] bool begin(Journal& journal);
  /// Compares the shard's pairs that the journal does not hold; counts them in `done`.
  void run(const Methods& methods, const Shard& shard, Journal& journal, std::size_t& done);

 private:
  /// Maps the wanted pairs on the threads and hands the results on in order.
  template <class Wanted, class Work, class Consume>
  void for_pairs(Wanted&& wanted, Work&& work, Consume&& consume) {
    PairStream stream(source_, scan_, extractor_);
    const auto next = [&]() -> std::optional<StreamPair> {
      while (hooks_.keep_going()) {
        auto pair = stream.next();
        if (!pair || wanted(pair->ordinal)) return pair;
      }
      return std::nullopt;
    };
    const auto map = [&](const StreamPair& pair) {
      const auto known = learned_.find(pair.ordinal);
      return known != learned_.end() ? work(pair, known->second)
                                     : work(pair, pair.correspond(extractor_));
    };
    ordered_pipeline(
        next, map,
        [&](auto result) {
          consume(std::move(result));
          return hooks_.keep_going();
        },
        hooks_.threads);
  }

  void require_same_images() const;
  [[nodiscard]] bool learn_tilt();
  void prepare_reference();
  void judge_gps();
  [[nodiscard]] PairRecord estimate(const StreamPair& pair, const PairAcs& acs,
                                    const Methods& methods) const;
  [[nodiscard]] MethodResult timed(const PairAcs& acs, const RelativePoseInitialiser& method,
                                   int trial) const;

  const CompareSettings& settings_;
  std::size_t log_;
  const CompareHooks& hooks_;
  SourceOptions source_;
  PairExtractor extractor_;
  LogScan scan_;
  LogRecord record_;
  Eigen::Matrix3d R_level_cam_ = Eigen::Matrix3d::Identity();
  std::optional<PairReference> reference_;
  std::map<std::size_t, PairAcs> learned_;  ///< of the pairs that the tilt was learned from
};

}  // namespace oneac::internal
