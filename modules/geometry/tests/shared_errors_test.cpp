#include "oneac/geometry/shared_errors.h"

#include <gtest/gtest.h>

#include <random>

namespace oneac {
namespace {

using Cells = GradientsOfCells<2>;

/// Gradients of 1σ = 1 over a picture of 600 × 400, those of its left third pulled by `pull`.
struct Terms {
  Cells cells;
  Eigen::Matrix2d V = Eigen::Matrix2d::Zero();

  Terms(unsigned seed, double scale, const Eigen::Vector2d& pull) {
    std::mt19937 generator(seed);
    std::uniform_real_distribution<double> across(0.0, 600.0), down(0.0, 400.0);
    std::normal_distribution<double> normal;
    for (int i = 0; i < 1000; ++i) {
      const Eigen::Vector2d x(across(generator), down(generator));
      Eigen::Vector2d g(normal(generator), normal(generator));
      if (x.x() < 200.0) g += pull;
      cells.add(scale * x, g);
      V += g * g.transpose();
    }
  }
};

TEST(GradientsOfCells, OfIndependentTermsShareLittle) {
  double mean = 0.0;
  constexpr unsigned kScenes = 20;
  for (unsigned seed = 0; seed < kScenes; ++seed) {
    const Terms terms(seed, 1.0, {0.0, 0.0});
    mean += terms.cells.shared(terms.V).trace() / terms.V.trace() / kScenes;
  }
  EXPECT_LT(mean, 5.0);  // a tenfold reach of what 24 cells cannot tell from nothing
}

TEST(GradientsOfCells, WhatNeighboursShareCountsAlongItsOwnAxis) {
  const Terms terms(1, 1.0, {1.0, 0.0});
  const Eigen::Matrix2d shared = terms.cells.shared(terms.V);
  EXPECT_GT(shared(0, 0), 50.0 * terms.V(0, 0));
  EXPECT_LT(shared(1, 1), 10.0 * terms.V(1, 1));
}

TEST(GradientsOfCells, PullsOfTwoPartsOfTheImageDoNotCancel) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> across(-300.0, 300.0), down(-200.0, 200.0);
  for (const int axis : {0, 1}) {
    Cells cells;
    Eigen::Matrix2d V = 1e-6 * Eigen::Matrix2d::Identity();
    for (int i = 0; i < 1000; ++i) {
      const Eigen::Vector2d x(across(generator), down(generator));
      const Eigen::Vector2d g(x[axis] > 0.0 ? 1.0 : -1.0, 0.0);
      cells.add(x, g);
      V += g * g.transpose();
    }
    EXPECT_GT(cells.shared(V)(0, 0), 50.0 * V(0, 0)) << axis;
  }
}

TEST(GradientsOfCells, KnowNoUnit) {
  const Terms pixels(2, 1.0, {0.5, 0.2}), rays(2, 0x1p-10, {0.5, 0.2});
  EXPECT_EQ(pixels.cells.shared(pixels.V), rays.cells.shared(rays.V));
}

TEST(GradientsOfCells, OfNothingOrOnePlaceAreFinite) {
  Cells cells;
  EXPECT_EQ(cells.shared(Eigen::Matrix2d::Identity()), Eigen::Matrix2d::Zero());
  EXPECT_EQ(cells.shared(Eigen::Matrix2d::Zero()), Eigen::Matrix2d::Zero());
  for (int i = 0; i < 3; ++i) cells.add({5.0, 5.0}, {1.0, 0.0});
  EXPECT_TRUE(cells.shared(Eigen::Matrix2d::Identity()).allFinite());
  EXPECT_NEAR(cells.shared(Eigen::Matrix2d::Identity())(0, 0), 80.0, 1e-9);  // 10 (3² − 1)
}

}  // namespace
}  // namespace oneac
