#include "oneac/comparison/method.h"

#include "oneac/base/error.h"
#include "oneac/base/nearest_name.h"
#include "oneac/initialisers/checked_answer.h"

#include <mrpt/containers/yaml.h>

#include <algorithm>
#include <stdexcept>

namespace oneac {
namespace {

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool is_word(const std::vector<std::string>& names, const char* word) {
  return names.size() == 1 && names.front() == word;
}

std::string joined(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

[[noreturn]] void no_such(const std::string& what, const std::string& name,
                          const std::vector<std::string>& known) {
  throw InputError(what + " '" + name + "'",
                   "does not exist, did you mean '" + nearest_name(name, known) + "'?",
                   "choose from: " + joined(known));
}

/// Every estimator that some initialiser has.
std::vector<std::string> known_estimators() {
  std::vector<std::string> known;
  for (const std::string& name : initialiser_names()) {
    for (const std::string& estimator : make_initialiser(name)->estimators()) {
      if (!contains(known, estimator)) known.push_back(estimator);
    }
  }
  return known;
}

std::vector<std::string> chosen_estimators(const std::vector<std::string>& own,
                                           const std::vector<std::string>& wanted) {
  if (is_word(wanted, "all")) return own;
  if (wanted.empty() || is_word(wanted, "default")) return {own.front()};
  std::vector<std::string> chosen;
  for (const std::string& estimator : own) {
    if (contains(wanted, estimator)) chosen.push_back(estimator);
  }
  return chosen;
}

/// The short name of a short name or class name.
std::string short_name(const std::string& name, const std::vector<std::string>& known) {
  if (contains(known, name)) return name;
  for (const std::string& candidate : known) {
    if (name == make_initialiser(candidate)->GetRuntimeClass()->className) return candidate;
  }
  no_such("initialiser", name, known);
}

}  // namespace

std::vector<CompareMethod> plan_methods(const std::vector<std::string>& initialisers,
                                        const std::vector<std::string>& estimators) {
  const std::vector<std::string> known = initialiser_names();
  const bool all = initialisers.empty() || is_word(initialisers, "all");
  if (!is_word(estimators, "all") && !is_word(estimators, "default")) {
    const std::vector<std::string> some = known_estimators();
    for (const std::string& name : estimators) {
      if (!contains(some, name)) no_such("estimator", name, some);
    }
  }
  std::vector<CompareMethod> methods;
  for (const std::string& asked : all ? known : initialisers) {
    const std::string name = short_name(asked, known);
    const std::vector<std::string> own = make_initialiser(name)->estimators();
    for (const std::string& estimator : chosen_estimators(own, estimators)) {
      std::string label = name;
      if (estimator != own.front()) label.append("+").append(estimator);
      const bool twice = std::any_of(methods.begin(), methods.end(),
                                     [&](const CompareMethod& m) { return m.label == label; });
      if (!twice) methods.push_back({label, name, estimator});
    }
  }
  if (methods.empty()) {
    throw InputError("--estimators " + joined(estimators),
                     "none of the initialisers has such an estimator",
                     "use --estimators default or all");
  }
  return methods;
}

RelativePoseInitialiser::Ptr make_method(const CompareMethod& method,
                                         const std::string& parameters) {
  auto initialiser = make_initialiser(method.initialiser);
  mrpt::containers::yaml yaml = mrpt::containers::yaml::Map();
  if (!parameters.empty()) yaml = mrpt::containers::yaml::FromText(parameters);
  // A method with an estimator of its own has nothing to choose.
  if (initialiser->estimators().size() > 1) yaml["estimator"] = method.estimator;
  configure_checked(*initialiser, yaml);
  return initialiser;
}

}  // namespace oneac
