#include "oneac/initialisers/method_initialisers.h"

// MRPT's macros name the class in full and must stand outside the namespace.
IMPLEMENTS_VIRTUAL_MRPT_OBJECT(MethodInitialiser, oneac::RelativePoseInitialiser, oneac)
IMPLEMENTS_MRPT_OBJECT(Initialiser1acGround, oneac::MethodInitialiser, oneac)
IMPLEMENTS_MRPT_OBJECT(Initialiser1acSide, oneac::MethodInitialiser, oneac)
IMPLEMENTS_MRPT_OBJECT(Initialiser1acFront, oneac::MethodInitialiser, oneac)
IMPLEMENTS_MRPT_OBJECT(Initialiser1acWall, oneac::MethodInitialiser, oneac)
IMPLEMENTS_MRPT_OBJECT(Initialiser1acPlanar, oneac::MethodInitialiser, oneac)
IMPLEMENTS_MRPT_OBJECT(Initialiser1acPooled, oneac::MethodInitialiser, oneac)
IMPLEMENTS_MRPT_OBJECT(Initialiser2pcGround, oneac::MethodInitialiser, oneac)
IMPLEMENTS_MRPT_OBJECT(Initialiser3pcVertical, oneac::MethodInitialiser, oneac)
IMPLEMENTS_MRPT_OBJECT(Initialiser2pcPlanar, oneac::MethodInitialiser, oneac)
IMPLEMENTS_MRPT_OBJECT(Initialiser1pc, oneac::MethodInitialiser, oneac)
IMPLEMENTS_MRPT_OBJECT(Initialiser5pc, oneac::MethodInitialiser, oneac)
IMPLEMENTS_MRPT_OBJECT(Initialiser8pc, oneac::MethodInitialiser, oneac)
IMPLEMENTS_MRPT_OBJECT(Initialiser4pc, oneac::MethodInitialiser, oneac)
IMPLEMENTS_MRPT_OBJECT(Initialiser2ac, oneac::MethodInitialiser, oneac)

namespace oneac {
namespace {

template <bool ConsensusOptions::*kSolver>
void only(ConsensusOptions& options) {
  options.ground = options.planar = false;
  options.side_wall = options.front_wall = options.wall = false;
  options.*kSolver = true;
}

/// The pool is what the options say.
void as_configured(ConsensusOptions&) {}

}  // namespace

const Method& Initialiser1acGround::method() const {
  static const Method kMethod{"1ac_ground", MinimalMethod::k1acGround,
                              &only<&ConsensusOptions::ground>};
  return kMethod;
}

const Method& Initialiser1acSide::method() const {
  static const Method kMethod{"1ac_side", MinimalMethod::k1acSideWall,
                              &only<&ConsensusOptions::side_wall>};
  return kMethod;
}

const Method& Initialiser1acFront::method() const {
  static const Method kMethod{"1ac_front", MinimalMethod::k1acFrontWall,
                              &only<&ConsensusOptions::front_wall>};
  return kMethod;
}

const Method& Initialiser1acWall::method() const {
  static const Method kMethod{"1ac_wall", MinimalMethod::k1acWall, &only<&ConsensusOptions::wall>};
  return kMethod;
}

const Method& Initialiser1acPlanar::method() const {
  static const Method kMethod{"1ac_planar", MinimalMethod::k1acPlanar,
                              &only<&ConsensusOptions::planar>};
  return kMethod;
}

const Method& Initialiser1acPooled::method() const {
  static const Method kMethod{"1ac_pooled", std::nullopt, &as_configured};
  return kMethod;
}

const Method& Initialiser2pcGround::method() const {
  static const Method kMethod{"2pc_ground", MinimalMethod::k2pcGround, nullptr};
  return kMethod;
}

const Method& Initialiser3pcVertical::method() const {
  static const Method kMethod{"3pc_vertical", MinimalMethod::k3pcVertical, nullptr};
  return kMethod;
}

const Method& Initialiser2pcPlanar::method() const {
  static const Method kMethod{"2pc_planar", MinimalMethod::k2pcPlanar, nullptr};
  return kMethod;
}

const Method& Initialiser1pc::method() const {
  static const Method kMethod{"1pc", MinimalMethod::k1pcAckermann, nullptr};
  return kMethod;
}

const Method& Initialiser5pc::method() const {
  static const Method kMethod{"5pc", MinimalMethod::k5pc, nullptr};
  return kMethod;
}

const Method& Initialiser8pc::method() const {
  static const Method kMethod{"8pc", MinimalMethod::k8pc, nullptr};
  return kMethod;
}

const Method& Initialiser4pc::method() const {
  static const Method kMethod{"4pc", MinimalMethod::k4pc, nullptr};
  return kMethod;
}

const Method& Initialiser2ac::method() const {
  static const Method kMethod{"2ac", MinimalMethod::k2ac, nullptr};
  return kMethod;
}

void register_methods() {
  mrpt::rtti::registerClass(CLASS_ID(RelativePoseInitialiser));
  mrpt::rtti::registerClass(CLASS_ID(MethodInitialiser));
  mrpt::rtti::registerClass(CLASS_ID(Initialiser1acGround));
  mrpt::rtti::registerClass(CLASS_ID(Initialiser1acSide));
  mrpt::rtti::registerClass(CLASS_ID(Initialiser1acFront));
  mrpt::rtti::registerClass(CLASS_ID(Initialiser1acWall));
  mrpt::rtti::registerClass(CLASS_ID(Initialiser1acPlanar));
  mrpt::rtti::registerClass(CLASS_ID(Initialiser1acPooled));
  mrpt::rtti::registerClass(CLASS_ID(Initialiser2pcGround));
  mrpt::rtti::registerClass(CLASS_ID(Initialiser3pcVertical));
  mrpt::rtti::registerClass(CLASS_ID(Initialiser2pcPlanar));
  mrpt::rtti::registerClass(CLASS_ID(Initialiser1pc));
  mrpt::rtti::registerClass(CLASS_ID(Initialiser5pc));
  mrpt::rtti::registerClass(CLASS_ID(Initialiser8pc));
  mrpt::rtti::registerClass(CLASS_ID(Initialiser4pc));
  mrpt::rtti::registerClass(CLASS_ID(Initialiser2ac));
}

}  // namespace oneac
