#include "method_initialiser.h"

#include "oneac/base/error.h"
#include "oneac/initialisers/yaml_parameters.h"
#include "oneac/robust/degeneracy.h"
#include "oneac/robust/finite_acs.h"

#include <mrpt/containers/yaml.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <deque>
#include <stdexcept>
#include <utility>

namespace oneac {
namespace {

constexpr const char* kConsensus = "consensus";
constexpr const char* kGcRansac = "gc_ransac";

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// GC-RANSAC with what it does not look for itself.
RobustResult gc_ransac_with_degeneracies(const InitialiserInput& input, const Solver& solver,
                                         const InitialiserOptions& options) {
  const double threshold = options.gc_ransac.threshold_px / input.focal_px;
  const DegeneracyBounds bounds{threshold, options.consensus.standing_px / input.focal_px,
                                input.R_level_cam, input.prior};
  if (!input.acs.empty()) {
    if (auto stood = find_standing(input.acs, bounds)) return *stood;
  }
  RobustResult result = gc_ransac(input.acs, input.R_level_cam, input.focal_px, solver, input.seed,
                                  options.gc_ransac);
  if (result.status != PoseStatus::kOk) return result;
  const MotionDecision decision = resting_or_moving(input.acs, result.pose, bounds);
  if (decision.resting) {
    const RobustStatistics work = result.statistics;
    result = *decision.resting;
    result.statistics = work;
    return result;
  }
  result.motion = decision.evidence;
  resolve_one_plane(input.acs, input.R_level_cam, threshold, result);
  return result;
}

/// "1ac_ground" becomes "oneac::Initialiser1acGround".
std::string class_name_of(const std::string& method) {
  std::string name = "oneac::Initialiser";
  bool upper = true;
  for (const char c : method) {
    if (c != '_') name += upper ? static_cast<char>(std::toupper(c)) : c;
    upper = c == '_';
  }
  return name;
}

const std::deque<Method>& methods();

// MRPT creates objects by a function, from 2.14 on by one that captures nothing: so there is one
// for each place of the list.
using Creator = mrpt::rtti::CObject::Ptr (*)();
constexpr std::size_t kMostMethods = 32;

template <std::size_t I>
mrpt::rtti::CObject::Ptr create_method() {
  return std::make_shared<MethodInitialiser>(methods()[I]);
}

template <std::size_t... I>
constexpr std::array<Creator, sizeof...(I)> creators(std::index_sequence<I...>) {
  return {&create_method<I>...};
}

/// @throws std::out_of_range  more methods than kMostMethods
Creator creator_at(std::size_t place) {
  static constexpr auto kCreators = creators(std::make_index_sequence<kMostMethods>());
  return kCreators.at(place);
}

void add_method(const std::string& name, const Solver* solver, std::deque<Method>& all) {
  const Creator creator = creator_at(all.size());
  Method& method = all.emplace_back(Method{name, solver, class_name_of(name), {}});
  method.id = {method.class_name.c_str(), creator,
               [] { return CLASS_ID(RelativePoseInitialiser); }};
}

/// One per solver that has a method, and the pool; where they stand is where MRPT finds them.
const std::deque<Method>& methods() {
  static const std::deque<Method> kMethods = [] {
    std::deque<Method> all;
    for (const Solver& solver : solvers()) {
      if (!solver.method.empty()) add_method(std::string(solver.method), &solver, all);
    }
    add_method("1ac_pooled", nullptr, all);
    return all;
  }();
  return kMethods;
}

}  // namespace

std::vector<std::string> MethodInitialiser::estimators() const {
  std::vector<std::string> names;
  const Solver* solver = method_->solver;
  if (solver == nullptr || solver->pool != PoolUse::kNever) names.emplace_back(kConsensus);
  if (solver != nullptr) names.emplace_back(kGcRansac);
  return names;
}

MethodInitialiser::MethodInitialiser(const Method& method)
    : method_(&method), in_gc_ransac_(MethodInitialiser::estimators().front() == kGcRansac) {}

void MethodInitialiser::configure(const mrpt::containers::yaml& parameters) {
  InitialiserOptions options;
  ParameterTable table;
  table.add("", options);
  apply_yaml(parameters, name(), table);
  try {
    options.validate();
    if (options.estimator != "default" && !contains(estimators(), options.estimator)) {
      throw std::invalid_argument("estimator = " + options.estimator + ", must be " +
                                  estimators().front() + " for this method");
    }
  } catch (const std::invalid_argument& error) {
    throw InputError(name(), error.what(), "correct the value");
  }
  options_ = options;
  in_gc_ransac_ =
      (options.estimator == "default" ? estimators().front() : options.estimator) == kGcRansac;
}

InitialiserResult MethodInitialiser::estimate(const InitialiserInput& input) const {
  const FiniteAcs finite(input.acs);
  InitialiserInput clean = input;
  clean.acs = finite.acs();
  InitialiserResult result = estimate_finite(clean);
  result.inliers = finite.spread(std::move(result.inliers));
  MRPT_LOG_DEBUG_FMT("%s: %s, %zu of %zu correspondences agree", name().c_str(),
                     to_string(result.status), result.inlier_count, input.acs.size());
  return result;
}

InitialiserResult MethodInitialiser::estimate_finite(const InitialiserInput& input) const {
  if (in_gc_ransac_) return gc_ransac_with_degeneracies(input, *method_->solver, options_);
  ConsensusOptions consensus = options_.consensus;
  if (method_->solver != nullptr) consensus.pool = SolverPool::only(*method_->solver);
  return one_ac_consensus(input.acs, input.R_level_cam, input.focal_px, consensus, input.prior);
}

void register_methods() {
  mrpt::rtti::registerClass(CLASS_ID(RelativePoseInitialiser));
  for (const Method& method : methods()) mrpt::rtti::registerClass(&method.id);
}

}  // namespace oneac
