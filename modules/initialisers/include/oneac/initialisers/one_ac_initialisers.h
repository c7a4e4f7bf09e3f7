#pragma once

#include "oneac/initialisers/relative_pose_initialiser.h"
#include "oneac/robust/one_ac_consensus.h"

namespace oneac {

/// Exhaustive consensus over one-AC hypotheses; the derived classes choose the solvers.
class OneAcInitialiser : public RelativePoseInitialiser {
  ONEAC_DEFINE_VIRTUAL_MRPT_OBJECT(OneAcInitialiser)

 public:
  void configure(const mrpt::containers::yaml& parameters) override;
  [[nodiscard]] InitialiserResult estimate(const InitialiserInput& input) const override;

 protected:
  /// Restricts the configured options to the solvers of the class.
  virtual void choose_solvers(ConsensusOptions& options) const = 0;

 private:
  ConsensusOptions options_;
};

/// Ground, and plane-free planar hypotheses in one pool.
class Initialiser1acPooled : public OneAcInitialiser {
  DEFINE_MRPT_OBJECT(Initialiser1acPooled, oneac)
 public:
  [[nodiscard]] std::string name() const override { return "1ac_pooled"; }

 protected:
  void choose_solvers(ConsensusOptions& options) const override;
};

/// Hypotheses of the ground solver only.
class Initialiser1acGround : public OneAcInitialiser {
  DEFINE_MRPT_OBJECT(Initialiser1acGround, oneac)
 public:
  [[nodiscard]] std::string name() const override { return "1ac_ground"; }

 protected:
  void choose_solvers(ConsensusOptions& options) const override;
};

/// Hypotheses of the plane-free planar solver only.
class Initialiser1acPlanar : public OneAcInitialiser {
  DEFINE_MRPT_OBJECT(Initialiser1acPlanar, oneac)
 public:
  [[nodiscard]] std::string name() const override { return "1ac_planar"; }

 protected:
  void choose_solvers(ConsensusOptions& options) const override;
};

}  // namespace oneac
