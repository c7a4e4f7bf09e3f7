#include "solver_text.h"

#include <string_view>

namespace oneac::python {
namespace {

struct HeaderComment {
  std::string_view name;
  const char* text;
};
/// Made from solvers/*.h by header_comments.py; ends with an empty name.
constexpr HeaderComment kComments[] = {
#include "header_comments.inc"
    {"", ""}};

std::string comment_of(std::string_view name) {
  for (const HeaderComment& comment : kComments) {
    if (comment.name == name) return comment.text;
  }
  return {};
}

std::string signature_of(const Solver& solver) {
  return std::string(solver.name) + (solver.affine ? "(x1, x2, A)" : "(x1, x2)") + " -> Poses";
}

std::string points_shape(const Solver& solver) {
  const std::string k = std::to_string(solver.sample);
  return solver.sample == 1 ? "(2,) or (N, 2)" : "(" + k + ", 2) or (N, " + k + ", 2)";
}

std::string affinity_shape(const Solver& solver) {
  const std::string k = std::to_string(solver.sample);
  return solver.sample == 1 ? "(2, 2) or (N, 2, 2)" : "(" + k + ", 2, 2) or (N, " + k + ", 2, 2)";
}

std::string frame_of(const Solver& solver) {
  return solver.levelled() ? "Camera frame levelled, Y along gravity in both views (rotate_views)."
                           : "Camera frame as it is: X right, Y down, Z forward.";
}

}  // namespace

std::string docstring_of(const Solver& solver) {
  std::string text = signature_of(solver) + "\n\n" + comment_of(solver.name);
  text += "\nAssumes " + solver.assumptions() + "; solves for " + std::string(solver.unknowns) +
          ".\n" + frame_of(solver) +
          "\n\nParameters\n----------\nx1, x2 : " + points_shape(solver) +
          "\n    Normalised image points [-], x = K⁻¹ u, of one sample or N."
          "\n";
  if (solver.affine) text += "A : " + affinity_shape(solver) + "\n    Affinity ∂x2/∂x1 [-].\n";
  text += "\nReturns\n-------\nPoses\n    X2 = R X1 + t; unit of t: " + std::string(solver.unit) +
          ". At most " + std::to_string(solver.run.max_candidates) +
          " solution(s) per sample, none where it is degenerate.\n";
  return text +
         "\nRaises\n------\nValueError\n    Another shape, or a number that is not finite.\n"
         "    (oneac.solver(\"" +
         std::string(solver.name) + "\") has further forms.)\n";
}

std::string fault_of_samples(const Solver& solver, const Shape& given) {
  const bool one = solver.sample == 1;
  const auto k = static_cast<py::ssize_t>(solver.sample);
  return "x1 has shape " + text_of(given) + ", " + std::string(solver.name) + " takes " +
         text_of(one ? Shape{2} : Shape{k, 2}) + " for one sample or " +
         text_of(one ? Shape{-1, 2} : Shape{-1, k, 2}) + " for many";
}

Shape with_points(Shape shape) {
  shape.push_back(2);
  return shape;
}

}  // namespace oneac::python
