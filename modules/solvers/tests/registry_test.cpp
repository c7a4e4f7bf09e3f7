#include "oneac/solvers/registry.h"

#include "oneac/solvers/essential_5pc.h"
#include "oneac/solvers/relpose_1ac_planar_pitch.h"
#include "oneac/solvers/relpose_1ac_wall.h"
#include "oneac/solvers/relpose_2pc_planar.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

namespace oneac {
namespace {

int candidates(std::string_view name) {
  for (const SolverInfo& solver : kSolvers) {
    if (solver.name == name) return solver.max_candidates;
  }
  return -1;
}

template <class Set>
int capacity() {
  return static_cast<int>(Set::kCapacity);
}

TEST(SolverRegistry, NamesAreUniqueAndDocumented) {
  std::set<std::string_view> names;
  for (const SolverInfo& solver : kSolvers) {
    EXPECT_TRUE(names.insert(solver.name).second) << solver.name;
    EXPECT_GT(solver.correspondences, 0) << solver.name;
    EXPECT_FALSE(solver.assumptions.empty() || solver.unknowns.empty()) << solver.name;
    std::string page(solver.name);  // forms of one solver share its page
    for (const std::string suffix : {"_rapid", "_candidates"}) {
      if (page.size() > suffix.size() && page.substr(page.size() - suffix.size()) == suffix) {
        page.resize(page.size() - suffix.size());
      }
    }
    EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(ONEAC_SOLVER_PAGES) / (page + ".md")))
        << page;
  }
}

TEST(SolverRegistry, CandidatesAreTheCapacities) {
  const AffineCorrespondence ac;
  EXPECT_EQ(candidates("relpose_1ac_wall"), capacity<decltype(relpose_1ac_wall(ac))>());
  EXPECT_EQ(candidates("relpose_1ac_wall_candidates"),
            capacity<decltype(relpose_1ac_wall_candidates(ac))>());
  EXPECT_EQ(candidates("relpose_1ac_planar_pitch"),
            capacity<decltype(relpose_1ac_planar_pitch(ac))>());
  EXPECT_EQ(candidates("relpose_2pc_planar"), capacity<decltype(relpose_2pc_planar(AcSpan()))>());
  EXPECT_EQ(candidates("essential_5pc"), capacity<decltype(essential_5pc(AcSpan()))>());
}

TEST(SolverRegistry, TableOfTheDocumentationIsTheRegistrys) {
  const std::filesystem::path page = std::filesystem::path(ONEAC_SOLVER_PAGES) / "README.md";
  std::ifstream in(page);
  ASSERT_TRUE(in) << page;
  const std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  const std::string begin = "<!-- solver table: oneac_solver_table -->\n";
  const std::string end = "<!-- end of solver table -->\n";
  const std::size_t from = text.find(begin);
  const std::size_t to = text.find(end);
  ASSERT_TRUE(from != std::string::npos && to != std::string::npos) << page;
  EXPECT_EQ(text.substr(from + begin.size(), to - from - begin.size()), solver_table());
}

}  // namespace
}  // namespace oneac
