#include "oneac/frontend/suspension_tilt.h"

#include "oneac/test_support/scenes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace oneac {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr double kPeriod = 0.1;  // [s] between images
constexpr double kTurnNoise = 0.03 * kDegree;
constexpr double kTravelNoise = 0.4 * kDegree;

double nothing(double /*t*/) {
  return 0.0;
}

/// A drive as functions of time [s].
struct Drive {
  std::function<double(double)> pitch;            ///< [rad] of the body on its road
  std::function<double(double)> slope = nothing;  ///< [rad] of the road, rising
  std::function<double(double)> roll = nothing;   ///< [rad] of the body, to the right
  std::function<double(double)> yaw = nothing;    ///< [rad] to the right
  double speed = 8.0;                             ///< [m/s]
  double seconds = 6.0;
};

struct Errors {
  double rms = 0.0;          ///< [rad] of the filter's pitch
  double rms_of_zero = 0.0;  ///< [rad] of assuming that the springs are at rest
  double largest = 0.0;      ///< [rad]
  double normalised = 0.0;   ///< mean square of error over σ
};

TiltBelief mounted(double pitch, double sigma = 0.1 * kDegree) {
  return {{pitch, 0.0}, sigma, 0.3 * kDegree};
}

double pitch_of(const SuspensionTilt& filter) {
  return filter.tilt().tilt.pitch_up;
}

double sigma_of(const SuspensionTilt& filter) {
  return filter.tilt().pitch_sigma;
}

/// R_level_cam on the road of that moment, then R_world_cam.
Eigen::Matrix3d against_road(const Drive& drive, double t) {
  return levelling_rotation({drive.pitch(t), drive.roll(t)});
}
Eigen::Matrix3d in_world(const Drive& drive, double t) {
  const Eigen::Matrix3d road = (Eigen::AngleAxisd(drive.yaw(t), Eigen::Vector3d::UnitY()) *
                                Eigen::AngleAxisd(drive.slope(t), Eigen::Vector3d::UnitX()))
                                   .toRotationMatrix();
  return road * against_road(drive, t);
}

TiltStep step_until(const Drive& drive, double t, SceneGenerator& random) {
  TiltStep step;
  const Eigen::Vector3d noise(random.normal(kTurnNoise), random.normal(kTurnNoise),
                              random.normal(kTurnNoise));
  const double angle = std::max(noise.norm(), 1e-12);
  step.R_2_1 = Eigen::AngleAxisd(angle, noise / angle) * in_world(drive, t).transpose() *
               in_world(drive, t - kPeriod);
  step.seconds = kPeriod;
  step.length = drive.speed * kPeriod;
  if (drive.speed > 0.0) {
    const double rise = random.normal(kTravelNoise);
    const Eigen::Vector3d ahead(0.0, std::sin(rise), std::cos(rise));
    step.travel = TiltStep::Travel{against_road(drive, t).transpose() * ahead, kTravelNoise};
  }
  return step;
}

Errors follow(const Drive& drive, SuspensionTilt& filter, unsigned seed,
              const TiltBelief& mounting = mounted(0.0)) {
  SceneGenerator random(seed);
  Errors errors;
  const int steps = static_cast<int>(drive.seconds / kPeriod);
  for (int i = 1; i <= steps; ++i) {
    const double t = kPeriod * i;
    filter.add_step(step_until(drive, t, random), mounting);
    const double truth = drive.pitch(t);
    const double error = pitch_of(filter) - truth;
    errors.rms += error * error / steps;
    errors.rms_of_zero += truth * truth / steps;
    errors.largest = std::max(errors.largest, std::abs(error));
    errors.normalised += std::pow(error / sigma_of(filter), 2) / steps;
  }
  errors.rms = std::sqrt(errors.rms);
  errors.rms_of_zero = std::sqrt(errors.rms_of_zero);
  return errors;
}

/// 0 before `from`, 1 half a second later.
double ramp(double t, double from) {
  return std::min(std::max((t - from) / 0.5, 0.0), 1.0);
}

TEST(SuspensionTilt, FollowsTheDiveOfABrakingCar) {
  SuspensionTilt filter(mounted(0.0));
  Drive brakes{[](double t) { return -1.5 * kDegree * (ramp(t, 2.0) - ramp(t, 4.0)); }};
  const Errors errors = follow(brakes, filter, 1);
  EXPECT_LT(errors.rms, 0.3 * errors.rms_of_zero);
  EXPECT_LT(errors.largest, 0.6 * kDegree);
}

TEST(SuspensionTilt, FollowsADampedBounce) {
  SuspensionTilt filter(mounted(0.0));
  Drive bounces{
      [](double t) { return 2.0 * kDegree * std::exp(-t / 2.0) * std::sin(2.0 * M_PI * 1.5 * t); }};
  const Errors errors = follow(bounces, filter, 2);
  EXPECT_LT(errors.rms, 0.5 * errors.rms_of_zero);
}

TEST(SuspensionTilt, LearnsThatASlopeIsNoPitch) {
  SuspensionTilt filter(mounted(0.0));
  Drive climbs{[](double) { return 0.0; },
               [](double t) { return 1.7 * kDegree * ramp(t, 1.0); }};  // 3 % after 4 m
  EXPECT_LT(follow(climbs, filter, 3).largest, 1.5 * kDegree);
  EXPECT_NEAR(pitch_of(filter), 0.0, 0.3 * kDegree);
}

TEST(SuspensionTilt, RocksOnWhenTheCarHasStopped) {
  SuspensionTilt filter(mounted(0.0));
  Drive brakes{[](double t) { return -1.0 * kDegree * ramp(t, 2.0); }};
  (void)follow(brakes, filter, 5);
  Drive stands{[](double t) { return -1.0 * kDegree * (1.0 - ramp(t, 0.2)); }};
  stands.speed = 0.0;
  stands.seconds = 1.0;
  const double before = sigma_of(filter);
  EXPECT_LT(follow(stands, filter, 6).largest, 0.5 * kDegree);
  EXPECT_NEAR(pitch_of(filter), 0.0, 0.5 * kDegree);
  EXPECT_LT(sigma_of(filter), std::hypot(before, 0.15 * kDegree)) << "the road did not change";
}

TEST(SuspensionTilt, FindsAMountingThatIsGivenWrong) {
  const TiltBelief given = mounted(8.2 * kDegree, 1.0 * kDegree);
  SuspensionTilt filter(given);
  Drive drive{[](double) { return 6.9 * kDegree; }};
  drive.seconds = 1.0;
  (void)follow(drive, filter, 7, given);
  EXPECT_NEAR(pitch_of(filter), 6.9 * kDegree, 0.4 * kDegree);
}

// A right angle in two seconds, leaning outwards by 2 degrees: a filter of the pitch alone takes
// yaw for pitching, up to 1.3 degrees (and says that it is sure).
TEST(SuspensionTilt, TakesTheYawOfALeaningCarForNoPitching) {
  const auto bend = [](double t) { return std::clamp((t - 2.0) / 2.0, 0.0, 1.0); };
  Drive turns{nothing};
  turns.yaw = [&](double t) { return 90.0 * kDegree * bend(t); };
  turns.roll = [&](double t) { return -2.0 * kDegree * (ramp(t, 1.9) - ramp(t, 3.6)); };
  turns.speed = 5.0;
  SuspensionTilt filter(mounted(0.0));
  const Errors errors = follow(turns, filter, 10);
  EXPECT_LT(errors.rms, 0.2 * kDegree);
  EXPECT_LT(errors.largest, 0.5 * kDegree);
}

// A roll that is not known turns pitch into the direction of travel as the car yaws.
TEST(SuspensionTilt, LearnsItsRollFromABend) {
  constexpr double kRoll = 3.0 * kDegree;
  const TiltBelief unknown = {{0.0, 0.0}, 0.1 * kDegree, 5.0 * kDegree};
  Drive turns{nothing};
  turns.roll = [](double) { return kRoll; };
  turns.yaw = [](double t) { return 30.0 * kDegree * t; };
  turns.seconds = 3.0;
  SuspensionTilt filter(unknown);
  (void)follow(turns, filter, 12, unknown);
  EXPECT_NEAR(filter.tilt().tilt.roll_right, kRoll, 1.0 * kDegree);
}

TEST(SuspensionTilt, KeepsTheRollOfTheMountingInTheLongRun) {
  Drive straight{nothing};
  straight.seconds = 120.0;
  SuspensionTilt filter({{0.0, 3.0 * kDegree}, 0.1 * kDegree, 0.3 * kDegree});
  (void)follow(straight, filter, 11);
  EXPECT_NEAR(filter.tilt().tilt.roll_right, 0.0, 1.5 * kDegree);
  EXPECT_LT(filter.tilt().roll_sigma, 1.5 * kDegree);
}

TEST(SuspensionTilt, KnowsHowItLeanedBefore) {
  const SuspensionTilt filter({{2.0 * kDegree, 1.0 * kDegree}, 0.1, 0.1});
  const Eigen::Matrix3d before = levelling_rotation({0.5 * kDegree, -1.0 * kDegree});
  const Eigen::Matrix3d yawed = Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY()).toRotationMatrix();
  const Eigen::Matrix3d now = levelling_rotation(filter.tilt().tilt);
  const Tilt found = filter.tilt_before(now.transpose() * yawed * before);
  EXPECT_NEAR(found.pitch_up, 0.5 * kDegree, 1e-12);
  EXPECT_NEAR(found.roll_right, -1.0 * kDegree, 1e-12);
}

TEST(SuspensionTilt, IsSureOfItselfAsFarAsItIsRight) {
  double normalised = 0.0;
  constexpr int kDrives = 20;
  for (unsigned seed = 0; seed < kDrives; ++seed) {
    SuspensionTilt filter(mounted(0.0));
    // A slope that wanders as the filter assumes, in steps of 0.8 m.
    SceneGenerator random(100 + seed);
    std::vector<double> slope(70, 0.0);
    for (std::size_t i = 1; i < slope.size(); ++i) {
      slope[i] = slope[i - 1] + random.normal(0.1 * kDegree * std::sqrt(0.8));
    }
    const auto slope_at = [&](double t) {
      return slope[static_cast<std::size_t>(std::lround(t / kPeriod))];
    };
    Drive drive{[](double t) { return 0.5 * kDegree * std::sin(2.0 * M_PI * 0.5 * t); }, slope_at};
    normalised += follow(drive, filter, seed).normalised / kDrives;
  }
  EXPECT_GT(normalised, 0.6);
  EXPECT_LT(normalised, 1.4);
}

TEST(SuspensionTilt, MeasuresThePitchByTheDirectionOfTravelEitherWay) {
  for (const double sign : {1.0, -1.0}) {
    SuspensionTilt filter(mounted(0.0, 10.0 * kDegree));
    TiltStep step;
    step.seconds = kPeriod;
    step.length = 0.8;
    const Eigen::Vector3d ahead(0.0, std::sin(2.0 * kDegree), std::cos(2.0 * kDegree));
    step.travel = TiltStep::Travel{sign * ahead, 0.1 * kDegree};
    filter.add_step(step, mounted(0.0));
    EXPECT_NEAR(pitch_of(filter), 2.0 * kDegree, 0.01 * kDegree) << sign;
  }
}

TEST(SuspensionTilt, LearnsNothingOfACarThatMovesSideways) {
  SuspensionTilt filter(mounted(0.0, 10.0 * kDegree));
  TiltStep step;
  step.travel = TiltStep::Travel{Eigen::Vector3d(0.7, 0.1, 0.7).normalized(), 0.1 * kDegree};
  filter.add_step(step, mounted(0.0));
  EXPECT_EQ(pitch_of(filter), 0.0);
}

TEST(SuspensionTilt, GivesWayToNoBump) {
  SuspensionTilt filter(mounted(0.0));
  Drive drive{nothing};
  (void)follow(drive, filter, 8);
  const double before = pitch_of(filter);
  TiltStep bump;
  bump.seconds = kPeriod;
  bump.length = 0.8;
  bump.travel = TiltStep::Travel{
      Eigen::Vector3d(0.0, std::sin(10.0 * kDegree), std::cos(10.0 * kDegree)), kTravelNoise};
  filter.add_step(bump, mounted(0.0));
  EXPECT_LT(pitch_of(filter) - before, 0.5 * kDegree);
}

/// Pitch and its 1σ after one step, on a filter that was sure, whose direction rises by so much.
AngleBelief after_a_rise(double rise, double direction_sigma) {
  SuspensionTilt filter(mounted(0.0));
  Drive drive{nothing};
  (void)follow(drive, filter, 8);
  const double before = pitch_of(filter);
  TiltStep step;
  step.seconds = kPeriod;
  step.length = 0.8;
  step.travel = TiltStep::Travel{Eigen::Vector3d(0.0, std::sin(rise), std::cos(rise)), kTravelNoise,
                                 direction_sigma * direction_sigma * Eigen::Matrix3d::Identity()};
  filter.add_step(step, mounted(0.0));
  return {pitch_of(filter) - before, sigma_of(filter)};
}

TEST(SuspensionTilt, LearnsLessFromADirectionThatImagesHardlyKnow) {
  const double known = after_a_rise(0.4 * kDegree, 0.0).angle;
  const double hardly = after_a_rise(0.4 * kDegree, 1.5 * kDegree).angle;
  EXPECT_GT(known, 0.05 * kDegree);
  EXPECT_LT(hardly, 0.2 * known);
}

TEST(SuspensionTilt, LearnsNoMoreFromMoreImagesOfWhatLeadsThemAstray) {
  const auto sigma_at = [](double rate) {
    SuspensionTilt filter(mounted(0.0, 1.0 * kDegree));
    TiltStep step;
    step.seconds = 1.0 / rate;
    step.length = 8.0 / rate;
    step.travel = {Eigen::Vector3d::UnitZ(), 0.3 * kDegree,
                   Eigen::Matrix3d::Identity() * std::pow(2.0 * kDegree, 2)};
    for (int i = 0; i < rate; ++i) filter.add_step(step, mounted(0.0, 1.0 * kDegree));
    return sigma_of(filter);
  };
  EXPECT_NEAR(sigma_at(60.0), sigma_at(5.0), 0.1 * sigma_at(5.0));
}

TEST(SuspensionTilt, IsLessSureAfterADirectionThatContradictsIt) {
  EXPECT_GT(after_a_rise(2.5 * kDegree, 0.0).sigma, 1.5 * after_a_rise(0.1 * kDegree, 0.0).sigma);
}

TEST(SuspensionTilt, IsNotLedAstrayByAWayThatSpringsDoNotAllow) {
  const AngleBelief astray = after_a_rise(6.0 * kDegree, 0.0);
  EXPECT_LT(std::abs(astray.angle), 0.05 * kDegree);
  EXPECT_GT(astray.sigma, 0.25 * kDegree);
}

TEST(SuspensionTilt, IsAtRestAgainAfterAStepThatNobodySaw) {
  const TiltBelief mounting = mounted(2.0 * kDegree);
  SuspensionTilt filter(mounting);
  Drive brakes{[](double t) { return 2.0 * kDegree - 1.5 * kDegree * ramp(t, 2.0); }};
  (void)follow(brakes, filter, 9, mounting);
  filter.lose(mounting);
  EXPECT_EQ(pitch_of(filter), 2.0 * kDegree);
  EXPECT_GT(sigma_of(filter), 0.9 * kDegree);
}

TEST(SuspensionTilt, PassesOverStepsThatAreNone) {
  SuspensionTilt filter(mounted(0.0));
  TiltStep step;
  step.R_2_1.setConstant(std::nan(""));
  step.seconds = kPeriod;
  filter.add_step(step, mounted(0.0));
  EXPECT_EQ(pitch_of(filter), 0.0);
  step = {};
  step.travel = TiltStep::Travel{Eigen::Vector3d(0.0, 0.1, 1.0).normalized(), HUGE_VAL};
  filter.add_step(step, mounted(0.0));
  EXPECT_EQ(pitch_of(filter), 0.0);
}

}  // namespace
}  // namespace oneac
