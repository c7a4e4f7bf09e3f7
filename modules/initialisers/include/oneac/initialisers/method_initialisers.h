#pragma once

#include "oneac/initialisers/initialiser_options.h"
#include "oneac/initialisers/relative_pose_initialiser.h"

#include <optional>

namespace oneac {

/// One method of the paper's table, or one of its rivals.
struct Method {
  const char* name;                      ///< short name
  std::optional<MinimalMethod> minimal;  ///< what GC-RANSAC runs; none: consensus only
  /// Chooses the solvers of the consensus; none: GC-RANSAC only.
  void (*choose_solvers)(ConsensusOptions&);
};

/// A minimal solver in a robust estimator: exhaustive consensus for one affine correspondence,
/// GC-RANSAC for all. Standing and turning cameras and scenes of one plane are recognised first and
/// last, whatever the estimator.
class MethodInitialiser : public RelativePoseInitialiser {
  ONEAC_DEFINE_VIRTUAL_MRPT_OBJECT(MethodInitialiser)

 public:
  [[nodiscard]] std::string name() const override { return method().name; }
  [[nodiscard]] std::vector<std::string> estimators() const override;
  /// Keys: those of InitialiserOptions.
  /// @throws InputError also for an estimator that the method cannot run in
  void configure(const mrpt::containers::yaml& parameters) override;
  [[nodiscard]] InitialiserResult estimate(const InitialiserInput& input) const override;

 protected:
  [[nodiscard]] virtual const Method& method() const = 0;

 private:
  [[nodiscard]] InitialiserResult estimate_finite(const InitialiserInput& input) const;

  InitialiserOptions options_;
};

/// 1ac_ground: the ground solver.
class Initialiser1acGround : public MethodInitialiser {
  DEFINE_MRPT_OBJECT(Initialiser1acGround, oneac)
 protected:
  [[nodiscard]] const Method& method() const override;
};

/// 1ac_side: the solver for walls along the road.
class Initialiser1acSide : public MethodInitialiser {
  DEFINE_MRPT_OBJECT(Initialiser1acSide, oneac)
 protected:
  [[nodiscard]] const Method& method() const override;
};

/// 1ac_front: the solver for walls across the road.
class Initialiser1acFront : public MethodInitialiser {
  DEFINE_MRPT_OBJECT(Initialiser1acFront, oneac)
 protected:
  [[nodiscard]] const Method& method() const override;
};

/// 1ac_wall: the solver for any vertical wall.
class Initialiser1acWall : public MethodInitialiser {
  DEFINE_MRPT_OBJECT(Initialiser1acWall, oneac)
 protected:
  [[nodiscard]] const Method& method() const override;
};

/// 1ac_planar: the solver that needs no plane.
class Initialiser1acPlanar : public MethodInitialiser {
  DEFINE_MRPT_OBJECT(Initialiser1acPlanar, oneac)
 protected:
  [[nodiscard]] const Method& method() const override;
};

/// 1ac_pooled: the ground and the plane-free solver in one pool.
class Initialiser1acPooled : public MethodInitialiser {
  DEFINE_MRPT_OBJECT(Initialiser1acPooled, oneac)
 protected:
  [[nodiscard]] const Method& method() const override;
};

/// 2pc_ground: two points of the ground.
class Initialiser2pcGround : public MethodInitialiser {
  DEFINE_MRPT_OBJECT(Initialiser2pcGround, oneac)
 protected:
  [[nodiscard]] const Method& method() const override;
};

/// 3pc_vertical: three points of a vertical wall.
class Initialiser3pcVertical : public MethodInitialiser {
  DEFINE_MRPT_OBJECT(Initialiser3pcVertical, oneac)
 protected:
  [[nodiscard]] const Method& method() const override;
};

/// 2pc_planar: two points, any scene, planar motion.
class Initialiser2pcPlanar : public MethodInitialiser {
  DEFINE_MRPT_OBJECT(Initialiser2pcPlanar, oneac)
 protected:
  [[nodiscard]] const Method& method() const override;
};

/// 1pc: one point, circular motion.
class Initialiser1pc : public MethodInitialiser {
  DEFINE_MRPT_OBJECT(Initialiser1pc, oneac)
 protected:
  [[nodiscard]] const Method& method() const override;
};

/// 5pc: five points, any motion.
class Initialiser5pc : public MethodInitialiser {
  DEFINE_MRPT_OBJECT(Initialiser5pc, oneac)
 protected:
  [[nodiscard]] const Method& method() const override;
};

/// 8pc: eight points, any motion.
class Initialiser8pc : public MethodInitialiser {
  DEFINE_MRPT_OBJECT(Initialiser8pc, oneac)
 protected:
  [[nodiscard]] const Method& method() const override;
};

/// 4pc: a homography of four points.
class Initialiser4pc : public MethodInitialiser {
  DEFINE_MRPT_OBJECT(Initialiser4pc, oneac)
 protected:
  [[nodiscard]] const Method& method() const override;
};

/// 2ac: a homography of two affine correspondences.
class Initialiser2ac : public MethodInitialiser {
  DEFINE_MRPT_OBJECT(Initialiser2ac, oneac)
 protected:
  [[nodiscard]] const Method& method() const override;
};

/// Tells MRPT's class factory about these classes; harmless when repeated.
void register_methods();

}  // namespace oneac
