#pragma once

#include "oneac/initialisers/initialiser_options.h"
#include "oneac/initialisers/relative_pose_initialiser.h"
#include "oneac/solvers/registry.h"

#include <string>
#include <vector>

namespace oneac {

/// One method of the paper's table, or one of its rivals.
struct Method {
  std::string name;        ///< short name
  const Solver* solver;    ///< none: the pool of the consensus as the options say
  std::string class_name;  ///< MRPT's, e.g. "oneac::Initialiser1acGround"
  mrpt::rtti::TRuntimeClassId id;
};

/// A minimal solver in a robust estimator: exhaustive consensus for those of its pool, GC-RANSAC
/// for all. Standing and turning cameras and scenes of one plane are recognised first and last,
/// whatever the estimator. One MRPT class per method: their identities are made at run time, one
/// per row of the list of solvers.
class MethodInitialiser : public RelativePoseInitialiser {
 public:
  /// @pre the method outlives the object
  explicit MethodInitialiser(const Method& method);

  [[nodiscard]] const mrpt::rtti::TRuntimeClassId* GetRuntimeClass() const override {
    return &method_->id;
  }
  [[nodiscard]] mrpt::rtti::CObject* clone() const override { return new MethodInitialiser(*this); }
  [[nodiscard]] std::string name() const override { return method_->name; }
  [[nodiscard]] std::vector<std::string> estimators() const override;
  /// Keys: those of InitialiserOptions.
  /// @throws InputError also for an estimator that the method cannot run in
  void configure(const mrpt::containers::yaml& parameters) override;
  [[nodiscard]] InitialiserResult estimate(const InitialiserInput& input) const override;

 private:
  [[nodiscard]] InitialiserResult estimate_finite(const InitialiserInput& input) const;

  const Method* method_;
  InitialiserOptions options_;
  bool in_gc_ransac_ = false;  ///< the estimator that options and method come to
};

/// Tells MRPT's class factory about a class for each method; harmless when repeated.
void register_methods();

}  // namespace oneac
