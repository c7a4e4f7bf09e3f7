#include "oneac/solvers/registry.h"

namespace oneac {

std::string solver_table() {
  std::string table =
      "| solver | correspondences | assumptions | unknowns | candidates | unit of t | metric | ns "
      "|\n"
      "|---|---|---|---|---|---|---|---|\n";
  for (const SolverInfo& solver : kSolvers) {
    const std::string points = solver.correspondences == 1 ? " point" : " points";
    const std::string kind = solver.affine ? " affine" : points;
    const std::string cells[] = {
        "`" + std::string(solver.name) + "`",  std::to_string(solver.correspondences) + kind,
        std::string(solver.assumptions),       std::string(solver.unknowns),
        std::to_string(solver.max_candidates), std::string(solver.unit),
        solver.metric ? "yes" : "no",          std::to_string(solver.typical_ns)};
    for (const std::string& cell : cells) table += "| " + cell + " ";
    table += "|\n";
  }
  return table;
}

}  // namespace oneac
