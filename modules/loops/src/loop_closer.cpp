#include "oneac/loops/loop_closer.h"

#include "agreement.h"
#include "chain.h"
#include "descriptors.h"
#include "place_index.h"
#include "verification.h"
#include "vocabulary.h"

#include "oneac/base/check_bounds.h"
#include "oneac/base/ordered_pipeline.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

namespace oneac {

void LoopOptions::validate() const {
  check_bounds("loops", *this);
}

namespace {

using namespace internal;

// Keyframes of one place count once among candidates; beside a candidate they are its support.
constexpr std::size_t kOnePlace = 3;
// [m] from a keyframe to those that give its features depths: a tenth of what a street is wide, the
// least that parallax is worth something at. At most so many keyframes away.
constexpr double kBase_m = 1.0;
constexpr std::size_t kMostApart = 5;

struct StoredFeatures {
  std::vector<AffineFrame> frames;
  Descriptors8 descriptors;

  [[nodiscard]] AffineFeatures whole() const { return {frames, in_floats(descriptors)}; }
};

RelativePose relative(const Eigen::Isometry3d& T) {
  return {T.linear(), T.translation()};
}

/// A keyframe and the places that look like it.
struct Query {
  std::size_t keyframe = 0;
  std::vector<std::size_t> places;
};

}  // namespace

class LoopCloser::Impl {
 public:
  Impl(const LoopOptions& options, LoopCamera camera, Images images)
      : options_(options), verification_(options, camera), images_(std::move(images)) {}

  [[nodiscard]] AffineFeatures detect(const ImageView& image, const ImageView& mask) const {
    return verification_.detect(image, mask);
  }

  void add(const LoopKeyframe& keyframe, const AffineFeatures& features) {
    keyframes_.push_back(keyframe);
    features_.push_back({features.frames, in_bytes(features.descriptors)});
    chain_.add(keyframe);
  }

  [[nodiscard]] FoundLoops close(int threads, const Stop& stop) const {
    FoundLoops found;
    found.report.keyframes = keyframes_.size();
    found.report.not_metric = static_cast<std::size_t>(std::count_if(
        keyframes_.begin(), keyframes_.end(), [](const auto& k) { return !k.metric; }));
    const std::vector<Query> queries = confirmed(candidates(found.report));
    for (const Query& query : queries) found.report.candidates += query.places.size();
    const auto depths = depths_for(queries, threads, stop);
    std::vector<LoopConstraint> loops = verified(queries, depths, threads, stop, found.report);
    if (stop && stop()) return {{}, found.report};
    const std::size_t possible = loops.size();
    found.loops = agreeing(joining(loops, chain_, options_.driven_m), chain_,
                           static_cast<std::size_t>(options_.min_support));
    found.report.contradicted = possible - found.loops.size();
    return found;
  }

 private:
  using AllDepths = std::vector<FeatureDepths>;

  /// Places before each keyframe that look like it.
  [[nodiscard]] std::vector<Query> candidates(LoopReport& report) const {
    std::vector<Query> queries(keyframes_.size());
    std::vector<const Descriptors8*> descriptors;
    for (const StoredFeatures& one : features_) descriptors.push_back(&one.descriptors);
    const Vocabulary vocabulary = Vocabulary::learn(descriptors);
    std::vector<std::vector<std::uint32_t>> words;
    for (const Descriptors8* one : descriptors) words.push_back(vocabulary.words_of(*one));
    const PlaceIndex index(words, vocabulary.size());
    std::size_t end = 0;  // keyframes before it were left long enough ago
    for (std::size_t i = 0; i < keyframes_.size(); ++i) {
      while (chain_.driven(i) - chain_.driven(end) > options_.driven_m) ++end;
      queries[i].keyframe = i;
      if (!keyframes_[i].metric) continue;
      const auto most = static_cast<std::size_t>(options_.candidates);
      for (const AlikePlace& place : index.alike(i, end, most, kOnePlace)) {
        if (!keyframes_[place.keyframe].metric) continue;
        if (may_meet(place.keyframe, i, chain_)) {
          queries[i].places.push_back(place.keyframe);
        } else if (!chain_.known(place.keyframe, i)) {
          ++report.apart_by_gps;
        }
      }
    }
    return queries;
  }

  /// Those that the keyframe before or after supports by a candidate at about the same place.
  [[nodiscard]] static std::vector<Query> confirmed(const std::vector<Query>& queries) {
    const auto supports = [](const Query& neighbour, std::size_t place) {
      return std::any_of(neighbour.places.begin(), neighbour.places.end(), [&](std::size_t other) {
        return std::max(place, other) - std::min(place, other) <= 2 * kOnePlace;
      });
    };
    std::vector<Query> kept;
    for (std::size_t i = 0; i < queries.size(); ++i) {
      Query query{queries[i].keyframe, {}};
      for (const std::size_t place : queries[i].places) {
        const bool before = i > 0 && supports(queries[i - 1], place);
        const bool after = i + 1 < queries.size() && supports(queries[i + 1], place);
        if (before || after) query.places.push_back(place);
      }
      if (!query.places.empty()) kept.push_back(std::move(query));
    }
    return kept;
  }

  [[nodiscard]] View view(std::size_t keyframe) const {
    return {keyframe, features_[keyframe].whole(), images_(keyframe)};
  }

  /// The nearest keyframe in a direction from which depths show; none at an end of the part.
  [[nodiscard]] std::optional<std::size_t> neighbour(std::size_t i, int direction) const {
    std::size_t at = i;
    for (std::size_t apart = 1; apart <= kMostApart; ++apart) {
      if (direction < 0 ? at == 0 : at + 1 == keyframes_.size()) return std::nullopt;
      at = direction < 0 ? at - 1 : at + 1;
      if (!chain_.known(at, i) || !keyframes_[at].metric) break;
      if (std::abs(chain_.driven(at) - chain_.driven(i)) >= kBase_m) return at;
    }
    return std::nullopt;
  }

  [[nodiscard]] FeatureDepths depths_of(std::size_t i) const {
    FeatureDepths depths;
    const View own = view(i);
    if (own.image.empty()) return depths;
    for (const int direction : {-1, 1}) {
      const auto other = neighbour(i, direction);
      if (!other) continue;
      const View theirs = view(*other);
      if (theirs.image.empty()) continue;
      const Eigen::Isometry3d T =
          keyframes_[*other].T_first_cam.inverse() * keyframes_[i].T_first_cam;
      verification_.add_depths(own, theirs, relative(T), depths);
    }
    return depths;
  }

  [[nodiscard]] AllDepths depths_for(const std::vector<Query>& queries, int threads,
                                     const Stop& stop) const {
    std::set<std::size_t> ends;
    for (const Query& query : queries) {
      ends.insert(query.keyframe);
      ends.insert(query.places.begin(), query.places.end());
    }
    AllDepths depths(keyframes_.size());
    auto at = ends.begin();
    const auto next = [&]() -> std::optional<std::size_t> {
      return at == ends.end() ? std::nullopt : std::optional(*at++);
    };
    using Result = std::pair<std::size_t, FeatureDepths>;
    ordered_pipeline(
        next, [this](std::size_t i) { return Result(i, depths_of(i)); },
        [&](Result result) {
          depths[result.first] = std::move(result.second);
          return !(stop && stop());
        },
        threads);
    return depths;
  }

  /// How far verification came with a keyframe.
  struct Verdict {
    std::vector<LoopConstraint> loops;
    std::size_t verified = 0, impossible = 0;
  };

  [[nodiscard]] Verdict judge(const Query& query, const AllDepths& depths) const {
    Verdict verdict;
    const View second = view(query.keyframe);
    for (const std::size_t place : query.places) {
      const View first = view(place);
      if (first.image.empty() || second.image.empty()) continue;
      auto loop = verification_.verify(first, depths[place], second, depths[query.keyframe]);
      if (!loop) continue;
      ++verdict.verified;
      loop->first = place;
      loop->second = query.keyframe;
      add_scale(*loop);
      if (!is_possible(*loop, chain_)) {
        ++verdict.impossible;
        continue;
      }
      verdict.loops.push_back(*loop);
      // Where odometry has its say one is enough; else those that contradict it have to be known.
      if (chain_.known(place, query.keyframe)) break;
    }
    return verdict;
  }

  /// Landmarks on both sides are as long as the odometry was there.
  void add_scale(LoopConstraint& loop) const {
    const double sigma =
        std::max(keyframes_[loop.first].scale_sigma, keyframes_[loop.second].scale_sigma);
    const Eigen::Vector3d t = sigma * loop.T_2_1.t;
    loop.covariance.bottomRightCorner<3, 3>() += t * t.transpose();
    loop.sigma_length = std::hypot(loop.sigma_length, t.norm());
  }

  [[nodiscard]] std::vector<LoopConstraint> verified(const std::vector<Query>& queries,
                                                     const AllDepths& depths, int threads,
                                                     const Stop& stop, LoopReport& report) const {
    std::vector<LoopConstraint> loops;
    std::size_t at = 0;
    const auto next = [&]() -> std::optional<const Query*> {
      return at == queries.size() ? std::nullopt : std::optional(&queries[at++]);
    };
    ordered_pipeline(
        next, [&](const Query* query) { return judge(*query, depths); },
        [&](const Verdict& verdict) {
          report.verified += verdict.verified;
          report.impossible += verdict.impossible;
          loops.insert(loops.end(), verdict.loops.begin(), verdict.loops.end());
          return !(stop && stop());
        },
        threads);
    return loops;
  }

  LoopOptions options_;
  Verification verification_;
  Images images_;
  std::vector<LoopKeyframe> keyframes_;
  std::vector<StoredFeatures> features_;
  Chain chain_;
};

LoopCloser::LoopCloser(const LoopOptions& options, LoopCamera camera, Images images) {
  options.validate();
  camera.camera.validate();
  impl_ = std::make_unique<Impl>(options, std::move(camera), std::move(images));
}

LoopCloser::~LoopCloser() = default;

AffineFeatures LoopCloser::features(const ImageView& image, const ImageView& mask) const {
  return impl_->detect(image, mask);
}

void LoopCloser::add(const LoopKeyframe& keyframe, const AffineFeatures& features) {
  impl_->add(keyframe, features);
}

FoundLoops LoopCloser::close(int threads, const Stop& stop) const {
  return impl_->close(threads, stop);
}

}  // namespace oneac
