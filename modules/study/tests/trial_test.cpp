#include "oneac/study/trial.h"

#include "oneac/geometry/angles.h"
#include "oneac/geometry/essential.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <cmath>

namespace oneac {
namespace {

// Motion along the normal is a double root of the general wall and of both homographies: their
// error is the square root of rounding.
constexpr double kRounding_rad = 1e-6;

TEST(Trial, ZeroNoiseGivesZeroErrorForEveryMethodOfEveryExperiment) {
  for (const Experiment& experiment : experiments()) {
    const bool kept =
        experiment.sweep == StudySweep::kNoise || experiment.sweep == StudySweep::kWallAngle;
    if (!kept) continue;  // the others break somebody's model on purpose
    for (const double value : sweep_values(experiment.sweep)) {
      StudyScene scene = scene_at(experiment, value);
      scene.noise = {};
      for (std::uint64_t seed = 0; seed < 20; ++seed) {
        TrialRandom random(trial_seed(1, experiment.name, 0, seed));
        const auto acs = draw_correspondences(scene, NoiseShape::kFixed, random);
        for (const StudyMethod method : experiment.methods) {
          const AcSpan span(acs.data(), acs.size());
          const auto errors = errors_of(method, DataUse::kAll, span, scene);
          ASSERT_TRUE(errors) << experiment.name << " " << value << " " << method->label;
          EXPECT_LT(errors->rotation, kRounding_rad) << experiment.name << method->label;
          EXPECT_LT(errors->translation, 100 * kRounding_rad)
              << experiment.name << " " << value << " " << method->label << seed;
        }
      }
    }
  }
}

TEST(Trial, ScenesAreThoseOfThePaper) {
  for (const Experiment& experiment : experiments()) {
    for (const double value : sweep_values(experiment.sweep)) {
      const StudyScene scene = scene_at(experiment, value);
      EXPECT_DOUBLE_EQ(scene.plane.d, 1.0);
      EXPECT_NEAR(scene.plane.n.norm(), 1.0, 1e-15);
      EXPECT_NEAR(scene.T_2_1.t.norm(), 0.1, 1e-15);
      if (experiment.name == "slope_ground" || experiment.name == "level_ground" ||
          experiment.name == "focal_ground") {
        continue;  // not the paper's
      }
      // The camera's own way in the first frame: forward or to the right.
      const Eigen::Vector3d way = -(scene.T_2_1.R.transpose() * scene.T_2_1.t);
      const Eigen::Vector3d axis = experiment.motion == StudyMotion::kForward
                                       ? Eigen::Vector3d::UnitZ()
                                       : Eigen::Vector3d::UnitX();
      EXPECT_LT((way - 0.1 * axis).norm(), 1e-15);
    }
  }
}

TEST(Trial, NoiseLevelsAreThoseOfThePaper) {
  const NoiseLevel swept = scene_at(experiment_named("forward_ground"), 0.4).noise;
  EXPECT_DOUBLE_EQ(swept.point_px, 0.4);
  EXPECT_DOUBLE_EQ(swept.rotation_deg, 2.0);
  EXPECT_DOUBLE_EQ(swept.scale_percent, 2.0);
  const NoiseLevel turned = scene_at(experiment_named("forward_wall"), -30.0).noise;
  EXPECT_DOUBLE_EQ(turned.point_px, 1.0);
  EXPECT_DOUBLE_EQ(turned.rotation_deg, 5.0);
  const NoiseLevel tilted = scene_at(experiment_named("tilt_front"), 0.5).noise;
  EXPECT_DOUBLE_EQ(tilted.rotation_deg, 1.0);
  EXPECT_DOUBLE_EQ(tilted.scale_percent, 1.0);
}

TEST(Trial, TiltTurnsTheSecondCameraAboutItsXAxis) {
  const StudyScene scene = scene_at(experiment_named("tilt_ground"), 0.8);
  const Eigen::Matrix3d& R = scene.T_2_1.R;
  EXPECT_NEAR(std::acos(0.5 * (R.trace() - 1.0)), 0.8 * kDegree, 1e-9);
  EXPECT_LT((R * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitX()).norm(), 1e-15);
}

TEST(Trial, PointsLieOnThePlaneBeforeBothCamerasAndInBothImages) {
  for (const Experiment& experiment : experiments()) {
    for (const double value : sweep_values(experiment.sweep)) {
      StudyScene scene = scene_at(experiment, value);
      scene.noise = {};
      TrialRandom random(3);
      for (const AffineCorrespondence& ac :
           draw_correspondences(scene, NoiseShape::kUniform, random)) {
        const double depth = 1.0 / scene.plane.n.dot(Eigen::Vector3d(ac.x1.x(), ac.x1.y(), 1.0));
        EXPECT_GT(depth, 0.0);
        EXPECT_LE(depth, kStudyMaxDepth * (1.0 + 1e-12));
        const Eigen::Vector3d X1 = depth * Eigen::Vector3d(ac.x1.x(), ac.x1.y(), 1.0);
        const Eigen::Vector3d X2 = scene.T_2_1 * X1;
        EXPECT_LT((Eigen::Vector2d(X2.x(), X2.y()) / X2.z() - ac.x2).norm(), 1e-12);
        EXPECT_LE(ac.x1.cwiseAbs().maxCoeff(), kStudyHalfImage);
        EXPECT_LE(ac.x2.cwiseAbs().maxCoeff(), kStudyHalfImage);
      }
    }
  }
}

TEST(Trial, MethodsUseAsManyCorrespondencesAsTheirNamesSay) {
  const StudyScene scene = scene_at(experiment_named("forward_ground"), 0.5);
  TrialRandom random(8);
  const auto acs = draw_correspondences(scene, NoiseShape::kUniform, random);
  const auto error = [&](StudyMethod method, DataUse use, std::size_t broken) {
    auto changed = acs;
    changed[broken].x2 += Eigen::Vector2d(0.01, 0.02);
    return errors_of(method, use, AcSpan(changed.data(), 4), scene)->translation;
  };
  EXPECT_NE(error(study_method("relpose_1ac_ground"), DataUse::kMinimal, 0),
            error(study_method("relpose_1ac_ground"), DataUse::kMinimal, 1));
  EXPECT_EQ(error(study_method("relpose_1ac_ground"), DataUse::kMinimal, 1),
            error(study_method("relpose_1ac_ground"), DataUse::kMinimal, 3));
  EXPECT_EQ(error(study_method("homography_2ac"), DataUse::kMinimal, 2),
            error(study_method("homography_2ac"), DataUse::kMinimal, 3));
  EXPECT_NE(error(study_method("homography_2ac"), DataUse::kMinimal, 1),
            error(study_method("homography_2ac"), DataUse::kMinimal, 3));
  EXPECT_NE(error(study_method("relpose_1ac_ground"), DataUse::kAll, 2),
            error(study_method("relpose_1ac_ground"), DataUse::kAll, 3));
  EXPECT_NE(error(study_method("homography_2ac"), DataUse::kAll, 2),
            error(study_method("homography_2ac"), DataUse::kAll, 3));
}

TEST(Trial, EveryMethodIsGivenItsCandidateClosestToTheTruth) {
  const StudyScene scene = scene_at(experiment_named("forward_wall"), 40.0);
  int two = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    TrialRandom random(seed);
    const auto acs = draw_correspondences(scene, NoiseShape::kUniform, random);
    const AcSpan span(acs.data(), acs.size());
    for (const StudyMethod method :
         {study_method("relpose_1ac_wall"), study_method("homography_4pc"),
          study_method("homography_2ac")}) {
      const auto candidates = candidates_of(method, span, DataUse::kAll);
      two += candidates.size() == 2 ? 1 : 0;
      const auto errors = errors_of(method, DataUse::kAll, span, scene);
      for (const PlanePose& pose : candidates) {
        const double trace = (pose.motion.R * scene.T_2_1.R.transpose()).trace();
        const double rotation = std::acos(std::min(1.0, 0.5 * (trace - 1.0)));
        const double cosine =
            pose.motion.t.dot(scene.T_2_1.t) / (pose.motion.t.norm() * scene.T_2_1.t.norm());
        EXPECT_LE(errors->rotation + errors->translation,
                  rotation + std::acos(std::max(-1.0, std::min(1.0, cosine))) + 1e-6);
      }
    }
  }
  EXPECT_GT(two, 300);  // the choice exists
}

TEST(Trial, OnASlopeTheSolverOfKnownVerticalAloneIsExact) {
  const Experiment& experiment = experiment_named("slope_ground");
  StudyScene scene = scene_at(experiment, 5.0);
  EXPECT_NEAR(scene.T_2_1.t.y() / -scene.T_2_1.t.z(), 0.05, 1e-12);
  EXPECT_NEAR(scene.plane.n.dot(scene.T_2_1.t), 0.0, 1e-15);  // along the road
  scene.noise = {};
  scene.vertical_deg = 0.0;
  TrialRandom random(4);
  const auto acs = draw_correspondences(scene, NoiseShape::kFixed, random);
  const auto error = [&](const char* name) {
    return errors_of(study_method(name), DataUse::kAll, AcSpan(acs.data(), 4), scene)->translation;
  };
  EXPECT_LT(error("relpose_1ac_vertical"), kRounding_rad);
  EXPECT_GT(error("relpose_1ac_planar"), 0.04);
  EXPECT_GT(error("relpose_1ac_ground"), 0.04);
}

TEST(Trial, AWrongFocalLengthMisleadsThePlanarSolverAndNotTheOneThatFindsIt) {
  const StudyScene truth = scene_at(experiment_named("focal_ground"), 8.0);
  StudyScene scene = truth;
  scene.noise = {};
  TrialRandom random(5);
  auto acs = draw_correspondences(scene, NoiseShape::kFixed, random);
  measure(scene, acs, random);
  const auto error = [&](const char* name) {
    return errors_of(study_method(name), DataUse::kAll, AcSpan(acs.data(), 4), scene)->rotation;
  };
  EXPECT_LT(error("relpose_1ac_planar_focal"), kRounding_rad);
  EXPECT_GT(error("relpose_1ac_planar"), 1e-3);
}

TEST(Trial, TwoCirclesAreTheLeastSquaresOfTheEquations) {
  const StudyScene scene = scene_at(experiment_named("circles_ground"), 0.4);
  TrialRandom random(6);
  for (int i = 0; i < 50; ++i) {
    const auto acs = draw_correspondences(scene, NoiseShape::kUniform, random);
    const AcSpan span(acs.data(), 4);
    const auto cost = [&](const RelativePose& T) {
      const Eigen::Matrix3d E = essential_matrix(T);
      double sum = 0.0;
      for (const auto& ac : span) {
        sum += std::pow(ac.x2.homogeneous().dot(E * ac.x1.homogeneous()), 2) +
               affine_epipolar_residual(E, ac).squaredNorm();
      }
      return sum;
    };
    const auto circles = candidates_of(planar_two_circles(), span, DataUse::kAll);
    const auto planar = candidates_of(study_method("relpose_1ac_planar"), span, DataUse::kAll);
    ASSERT_EQ(circles.size(), 1U);
    ASSERT_EQ(planar.size(), 1U);
    EXPECT_LE(cost(circles[0].motion), cost(planar[0].motion) * (1.0 + 1e-9)) << "trial " << i;
  }
}

}  // namespace
}  // namespace oneac
