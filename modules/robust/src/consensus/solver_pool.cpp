#include "oneac/robust/solver_pool.h"

#include "oneac/solvers/registry.h"

#include <stdexcept>
#include <string>

namespace oneac {

const std::vector<const Solver*>& pool_solvers() {
  static const std::vector<const Solver*> kPool = [] {
    std::vector<const Solver*> pool;
    for (const Solver& solver : solvers()) {
      if (solver.pool != PoolUse::kNever) pool.push_back(&solver);
    }
    if (pool.size() > SolverPool::kMost) throw std::logic_error("solver pool: raise kMost");
    return pool;
  }();
  return kPool;
}

SolverPool::SolverPool() {
  const auto& pool = pool_solvers();
  for (std::size_t i = 0; i < pool.size(); ++i) on[i] = pool[i]->pool == PoolUse::kOn;
}

SolverPool SolverPool::only(const Solver& solver) {
  SolverPool pool;
  pool.on.fill(false);
  if (solver.pool == PoolUse::kNever) {
    throw std::invalid_argument("solver = " + std::string(solver.name) + ", must be of the pool");
  }
  pool[solver.pool_key()] = true;
  return pool;
}

std::size_t SolverPool::size() {
  return pool_solvers().size();
}

const char* SolverPool::key(std::size_t i) {
  return pool_solvers()[i]->pool_key();
}

std::string SolverPool::meaning(std::size_t i) {
  return "hypotheses for " + pool_solvers()[i]->assumptions();
}

bool& SolverPool::operator[](std::string_view key) {
  const auto& pool = pool_solvers();
  for (std::size_t i = 0; i < pool.size(); ++i) {
    if (pool[i]->pool_key() == key) return on[i];
  }
  throw std::invalid_argument("consensus." + std::string(key) + ", must be a solver of the pool");
}

}  // namespace oneac
