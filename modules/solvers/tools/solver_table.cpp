// Prints the Markdown table of the solvers.

#include "oneac/solvers/registry.h"

#include <iostream>

int main() {
  std::cout << oneac::solver_table();
  return 0;
}
