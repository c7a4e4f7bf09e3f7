#include "texture.h"

#include "oneac/features/ac_tracker.h"
#include "oneac/features/feature_options.h"

#include <gtest/gtest.h>

#include <map>
#include <stdexcept>
#include <vector>

namespace oneac {
namespace {

View drive(int frame) {
  View view;
  view.shift = {-4.0 * frame, 1.0 * frame};
  view.A *= 1.0 + 0.02 * frame;
  view.noise = 2.0;
  view.seed = 70 + static_cast<std::uint64_t>(frame);
  return view;
}

std::vector<TrackedPair> pairs_of(const std::string& extractor, AcTracker& tracker) {
  const Texture texture(41);
  std::vector<TrackedPair> pairs;
  pairs.reserve(3);
  for (int frame = 0; frame < 3; ++frame) {
    pairs.push_back(tracker.advance(tracker.prepare(render(texture, drive(frame)).view()), {}));
  }
  EXPECT_TRUE(pairs.front().empty()) << extractor;
  return pairs;
}

std::unique_ptr<AcTracker> tracker_named(const std::string& name) {
  FeatureOptions options;
  options.extractor = name;
  return make_tracker(options);
}

double median_affine_error(const std::string& extractor) {
  const auto tracker = tracker_named(extractor);
  const auto pairs = pairs_of(extractor, *tracker);
  const Eigen::Matrix2d truth = drive(2).A * drive(1).A.inverse();
  std::vector<double> errors;
  for (const auto& ac : pairs.back().correspondences) errors.push_back((ac.A - truth).norm());
  EXPECT_GT(errors.size(), 80U) << extractor;
  return median_of(errors);
}

TEST(MatchedTracker, ChainsTracksThroughSharedFeatures) {
  for (const char* extractor : {"vlfeat", "vlfeat+align", "sift"}) {
    const auto tracker = tracker_named(extractor);
    const auto pairs = pairs_of(extractor, *tracker);
    std::map<std::uint64_t, Eigen::Vector2d> middle;
    for (std::size_t i = 0; i < pairs[1].size(); ++i) {
      EXPECT_TRUE(
          middle.emplace(pairs[1].correspondences[i].track, pairs[1].correspondences[i].x2).second);
    }
    std::size_t shared = 0;
    for (std::size_t i = 0; i < pairs[2].size(); ++i) {
      const auto before = middle.find(pairs[2].correspondences[i].track);
      if (before == middle.end()) continue;
      ++shared;
      EXPECT_LT((before->second - pairs[2].correspondences[i].x1).norm(), 4.5);
    }
    EXPECT_GT(shared, 40U) << extractor;
  }
}

TEST(MatchedTracker, AlignmentImprovesAffinities) {
  const double matched = median_affine_error("vlfeat");
  const double aligned = median_affine_error("vlfeat+align");
  EXPECT_LT(aligned, 0.5 * matched);
  EXPECT_LT(aligned, 0.02);
  EXPECT_LT(median_affine_error("sift"), 0.02);
}

TEST(MatchedTracker, ReportsStanding) {
  const auto tracker = tracker_named("vlfeat");
  const GreyImage image = render(Texture(42), View{});
  static_cast<void>(tracker->advance(tracker->prepare(image.view()), {}));
  EXPECT_TRUE(tracker->advance(tracker->prepare(image.view()), {}).standing);
}

TEST(MakeTracker, RefusesAnUnknownName) {
  EXPECT_THROW(static_cast<void>(tracker_named("surf")), std::invalid_argument);
}

TEST(MakeTracker, RefusesFramesOfAnotherExtractor) {
  const auto klt = tracker_named("klt"), vlfeat = tracker_named("vlfeat");
  const auto frame = vlfeat->prepare(render(Texture(43), View{}).view());
  EXPECT_THROW(static_cast<void>(klt->advance(frame, {})), std::invalid_argument);
}

}  // namespace
}  // namespace oneac
