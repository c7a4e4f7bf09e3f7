#include "oneac/features/vlfeat_extractor.h"

#include "oneac/test_support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace oneac {
namespace {

/// A picture of soft random blobs, as a function of real coordinates, so that it can be warped
/// without interpolation.
class BlobPicture {
 public:
  explicit BlobPicture(std::uint64_t seed) {
    SceneGenerator scene(seed);
    for (int i = 0; i < 400; ++i) {
      blobs_.push_back({scene.uniform(0, 320), scene.uniform(0, 240), scene.uniform(2, 9),
                        scene.uniform(2, 9), scene.uniform(0, 3.1), scene.uniform(-70, 70)});
    }
  }

  [[nodiscard]] double operator()(const Eigen::Vector2d& u) const {
    double value = 128.0;
    for (const Blob& b : blobs_) {
      const double dx = u.x() - b.x, dy = u.y() - b.y;
      if (std::abs(dx) > 32.0 || std::abs(dy) > 32.0) continue;  // beyond 3.5 sigma of the widest
      const double c = std::cos(b.angle), s = std::sin(b.angle);
      const double p = (c * dx + s * dy) / b.width, q = (-s * dx + c * dy) / b.height;
      const double r2 = p * p + q * q;
      if (r2 < 12.0) value += b.grey * std::exp(-0.5 * r2);
    }
    return value;
  }

  /// The image whose pixel u shows the picture at A⁻¹ (u − shift).
  [[nodiscard]] GreyImage render(const Eigen::Matrix2d& A, const Eigen::Vector2d& shift) const {
    GreyImage image(320, 240);
    const Eigen::Matrix2d inverse = A.inverse();
    for (int v = 0; v < 240; ++v) {
      for (int u = 0; u < 320; ++u) {
        const double grey = (*this)(inverse * (Eigen::Vector2d(u, v) - shift));
        image.row(v)[u] = static_cast<std::uint8_t>(std::clamp(std::lround(grey), 0L, 255L));
      }
    }
    return image;
  }

 private:
  struct Blob {
    double x, y, width, height, angle, grey;
  };
  std::vector<Blob> blobs_;
};

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

TEST(VlfeatExtractor, RecoversAKnownAffineWarp) {
  const BlobPicture picture(51);
  Eigen::Matrix2d A;
  A << 1.08, 0.05, -0.04, 0.97;
  const Eigen::Vector2d shift(6.0, -4.0);
  const GreyImage first = picture.render(Eigen::Matrix2d::Identity(), Eigen::Vector2d::Zero());
  const GreyImage second = picture.render(A, shift);
  const VlfeatExtractor extractor{FeatureOptions{}};
  const auto acs =
      extractor.correspond(*extractor.prepare(first.view()), *extractor.prepare(second.view()));
  ASSERT_GT(acs.size(), 50U);
  std::vector<double> point_errors, affine_errors;
  for (const auto& ac : acs) {
    point_errors.push_back((A * ac.x1 + shift - ac.x2).norm());
    affine_errors.push_back((ac.A - A).norm());
  }
  EXPECT_LT(median(point_errors), 0.5);
  EXPECT_LT(median(affine_errors), 0.15);
}

TEST(VlfeatExtractor, GivesTheSameFeaturesEachTime) {
  const GreyImage image = BlobPicture(52).render(Eigen::Matrix2d::Identity(), {0.0, 0.0});
  const AffineFeatures a = detect_vlfeat(image.view(), {});
  const AffineFeatures b = detect_vlfeat(image.view(), {});
  ASSERT_EQ(a.frames.size(), b.frames.size());
  EXPECT_TRUE(a.descriptors == b.descriptors);
}

TEST(VlfeatExtractor, MakesUnitRootSiftDescriptors) {
  const GreyImage image = BlobPicture(53).render(Eigen::Matrix2d::Identity(), {0.0, 0.0});
  const AffineFeatures features = detect_vlfeat(image.view(), {});
  ASSERT_GT(features.frames.size(), 20U);
  for (Eigen::Index i = 0; i < features.descriptors.rows(); ++i) {
    EXPECT_NEAR(features.descriptors.row(i).norm(), 1.0F, 1e-4F);
    EXPECT_GE(features.descriptors.row(i).minCoeff(), 0.0F);
  }
}

TEST(VlfeatExtractor, KeepsTheStrongestWhenThereAreTooMany) {
  const GreyImage image = BlobPicture(54).render(Eigen::Matrix2d::Identity(), {0.0, 0.0});
  VlfeatOptions few;
  few.max_features = 20;
  const std::size_t all = detect_vlfeat(image.view(), {}).frames.size();
  const std::size_t kept = detect_vlfeat(image.view(), few).frames.size();
  EXPECT_LE(kept, 60U);  // up to a few orientations each
  EXPECT_GE(kept, 10U);
  EXPECT_GT(all, 2 * kept);
}

TEST(VlfeatExtractor, FindsNothingInAnEmptyPicture) {
  for (std::uint8_t grey : {std::uint8_t{0}, std::uint8_t{255}}) {
    EXPECT_TRUE(detect_vlfeat(GreyImage(64, 48, grey).view(), {}).frames.empty());
  }
}

TEST(MakeExtractor, RefusesAnUnknownName) {
  FeatureOptions options;
  options.extractor = "surf";
  EXPECT_THROW(static_cast<void>(make_extractor(options)), std::invalid_argument);
}

}  // namespace
}  // namespace oneac
