#include "oneac/comparison/method.h"

#include "oneac/base/error.h"

#include <gtest/gtest.h>

namespace oneac {
namespace {

TEST(PlanMethods, AllIsEveryRegisteredInitialiser) {
  const auto methods = plan_methods({"all"}, {"default"});
  ASSERT_EQ(methods.size(), initialiser_names().size());
  for (const CompareMethod& method : methods) EXPECT_EQ(method.label, method.initialiser);
}

TEST(PlanMethods, KeepsTheOrderOfTheNamesAndEachOnce) {
  const auto methods = plan_methods({"1ac_pooled", "1ac_ground", "1ac_pooled"}, {"default"});
  ASSERT_EQ(methods.size(), 2U);
  EXPECT_EQ(methods[0].label, "1ac_pooled");
  EXPECT_EQ(methods[1].label, "1ac_ground");
}

TEST(PlanMethods, LabelsOtherEstimatorsBehindAPlus) {
  for (const CompareMethod& method : plan_methods({"all"}, {"all"})) {
    const auto estimators = make_initialiser(method.initialiser)->estimators();
    EXPECT_EQ(method.label, method.estimator == estimators.front()
                                ? method.initialiser
                                : method.initialiser + "+" + method.estimator);
  }
}

TEST(PlanMethods, SuggestsTheNearestName) {
  try {
    static_cast<void>(plan_methods({"1ac_poled"}, {"default"}));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("'1ac_pooled'"), std::string::npos) << error.what();
  }
  EXPECT_THROW(static_cast<void>(plan_methods({"all"}, {"consensis"})), InputError);
}

TEST(MakeMethod, ConfiguresEveryMethod) {
  for (const CompareMethod& method : plan_methods({"all"}, {"all"})) {
    EXPECT_EQ(make_method(method, "consensus:\n  modes: 4\n")->name(), method.initialiser);
  }
}

}  // namespace
}  // namespace oneac
