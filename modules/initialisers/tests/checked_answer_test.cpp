#include "oneac/initialisers/checked_answer.h"

#include <gtest/gtest.h>
#include <mrpt/containers/yaml.h>

#include <functional>
#include <limits>
#include <stdexcept>
#include <utility>

namespace oneac {
namespace {

constexpr std::size_t kAcs = 5;

InitialiserResult good() {
  InitialiserResult answer;
  answer.status = PoseStatus::kOk;
  answer.pose = {yaw_rotation(0.8, 0.6), {0.0, 0.0, -1.0}};
  answer.inliers = {true, true, false, true, false};
  answer.inlier_count = 3;
  return answer;
}

/// An initialiser that does what a test wants.
class Puppet : public RelativePoseInitialiser {
 public:
  explicit Puppet(std::function<InitialiserResult()> play) : play_(std::move(play)) {}
  std::string name() const override { return "puppet"; }
  void configure(const mrpt::containers::yaml&) override {}
  InitialiserResult estimate(const InitialiserInput&) const override { return play_(); }
  // What MRPT's macro would define.
  const mrpt::rtti::TRuntimeClassId* GetRuntimeClass() const override {
    return CLASS_ID(RelativePoseInitialiser);
  }
  mrpt::rtti::CObject* clone() const override { return new Puppet(play_); }

 private:
  std::function<InitialiserResult()> play_;
};

CheckedAnswer answer_of(const std::function<InitialiserResult()>& play) {
  const std::vector<AffineCorrespondence> acs(kAcs);
  InitialiserInput input;
  input.acs = acs;
  return checked_answer(Puppet(play), input);
}

TEST(CheckedAnswer, TakesWhatKeepsThePromise) {
  EXPECT_EQ(fault_of_answer(good(), kAcs), "");
  InitialiserResult still = good();
  still.status = PoseStatus::kNoMotion;
  still.pose = {};
  EXPECT_EQ(fault_of_answer(still, kAcs), "");
  EXPECT_EQ(fault_of_answer({}, kAcs), "");  // no pose
}

TEST(CheckedAnswer, NamesWhatIsWrong) {
  static constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  using Break = std::function<void(InitialiserResult&)>;
  const std::vector<std::pair<const char*, Break>> broken = {
      {"R is no", [](auto& a) { a.pose.R *= kNan; }},
      {"R is no", [](auto& a) { a.pose.R.setZero(); }},
      {"R is no", [](auto& a) { a.pose.R *= 1e308; }},
      {"R is no", [](auto& a) { a.pose.R *= -1.0; }},
      {"t is not finite", [](auto& a) { a.pose.t.x() = kNan; }},
      {"length 1", [](auto& a) { a.pose.t *= 2.0; }},
      {"length 0", [](auto& a) { a.status = PoseStatus::kNoMotion; }},
      {"no motion, and its R turns",
       [](auto& a) {
         a.status = PoseStatus::kNoMotion;
         a.pose.t.setZero();
       }},
      {"count more than can be", [](auto& a) { a.statistics.iterations = ~std::size_t{0}; }},
      {"counts 77 inliers of 5",
       [](auto& a) {
         a.status = PoseStatus::kTooFew;
         a.inlier_count = 77;
       }},
      {"3 inlier flags for 5", [](auto& a) { a.inliers.resize(3); }},
      {"counts 4 inliers and flags 3", [](auto& a) { a.inlier_count = 4; }},
      {"status is none", [](auto& a) { a.status = static_cast<PoseStatus>(77); }},
      {"covariance is not finite", [](auto& a) { a.covariance(2, 2) = kNan; }},
      {"evidence", [](auto& a) {
         a.motion.emplace();
         a.motion->length = kNan;
       }}};
  for (const auto& [words, spoil] : broken) {
    const CheckedAnswer answer = answer_of([&spoil = spoil] {
      InitialiserResult result = good();
      spoil(result);
      return result;
    });
    EXPECT_NE(answer.fault.find(words), std::string::npos) << words << ": " << answer.fault;
    EXPECT_EQ(answer.result.status, PoseStatus::kTooFew);
  }
}

TEST(CheckedAnswer, WhatIsThrownIsNoPose) {
  EXPECT_EQ(answer_of([]() -> InitialiserResult { throw std::runtime_error("boom"); }).fault,
            "it threw: boom");
  EXPECT_EQ(answer_of([]() -> InitialiserResult { throw 7; }).fault, "it threw");
}

}  // namespace
}  // namespace oneac
