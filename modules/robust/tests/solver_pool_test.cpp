#include "oneac/robust/solver_pool.h"

#include "oneac/solvers/registry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

namespace oneac {
namespace {

std::ptrdiff_t solvers_on(const SolverPool& pool) {
  return std::count(pool.on.begin(), pool.on.end(), true);
}

TEST(SolverPool, StartsAsTheListOfSolversSays) {
  SolverPool pool;
  EXPECT_TRUE(pool["ground"]);
  EXPECT_TRUE(pool["planar"]);
  EXPECT_FALSE(pool["side_wall"] || pool["front_wall"] || pool["wall"]);
  EXPECT_EQ(solvers_on(pool), 2);
}

TEST(SolverPool, OnlyTurnsTheOthersOff) {
  SolverPool pool = SolverPool::only(solver_named("relpose_1ac_wall"));
  EXPECT_TRUE(pool["wall"]);
  EXPECT_EQ(solvers_on(pool), 1);
}

TEST(SolverPool, RefusesSolversThatAreNoneOfIts) {
  SolverPool pool;
  EXPECT_THROW((void)pool["rapid"], std::invalid_argument);
  EXPECT_THROW((void)SolverPool::only(solver_named("essential_5pc")), std::invalid_argument);
}

}  // namespace
}  // namespace oneac
