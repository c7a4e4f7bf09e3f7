#pragma once

/// What the scalar solvers and their batch forms must agree on. Constants only: the batch kernels
/// are compiled for other instruction sets and must not pull in inline functions.
namespace oneac::internal {

// Smallest y of a ground point, oneac::kHorizon.
constexpr double kGroundHorizon = 0.0087;
// Pivots of a Gram matrix below this share of its trace are rounding: eps times a margin of 100.
constexpr double kSingularPlaneGram = 2e-14;
// Below this length [distances to the plane] t has no direction left: the normal equations keep
// about nine digits on the worst points that are let through.
constexpr double kNoPlaneMotion = 1e-8;
// Halley's method on the secular equation takes two steps at 2 % affine noise. It converges
// cubically: after a step of this share of the smallest eigenvalue the rest is 1e-12 of it.
constexpr int kHalleySteps = 6;
constexpr double kHalleyStep = 1e-4;
// Newton on the smallest eigenvalue takes two steps at 2 % affine noise; the rest is for noise so
// large that steps are halved. The vector's error is the cube of its last change, and the square of
// one so small that the second derivative is left out.
constexpr int kEigenvalueSteps = 40;
constexpr double kEigenvectorStep = 1e-4;
constexpr double kLinearStep = 1e-6;
// Inverse iteration with Rayleigh quotients triples the digits a step; the bisection takes over
// where these are not enough.
constexpr int kRayleighSteps = 6;
// (λ1 − λ)/λ2 at which one and two more inverse iterations leave less than 1e-10 of the other
// eigenvectors, of which a column of the adjugate has at most ten times that share.
constexpr double kVeryNear = 1e-6;
constexpr double kNear = 1e-4;
// Share of the trace of a diagonal entry of the adjugate whose column is as good as any.
constexpr double kTinyColumn = 0.01;
// Shares of the null vector of a last entry, and of a rotation, that are rounding.
constexpr double kNoLastEntry = 1e-9;
constexpr double kNoRotation = 1e-12;
// A determinant below this share of the squared trace is too near the hard case for Halley's
// method.
constexpr double kNearHardCase = 1e-7;
// A null vector of the planar 3×4 system shorter than this share of the product of the row lengths
// is rounding: two rows are then parallel and the motion is not determined.
constexpr double kParallelRows = 1e-12;

}  // namespace oneac::internal
