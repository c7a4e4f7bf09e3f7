#!/usr/bin/env bash
# Builds the unit tests with the address and undefined-behaviour sanitizers and runs them.
#   tests/sanitize.sh [TEST_PROGRAM...]    e.g. tests/sanitize.sh robust_test solvers_test
# Without arguments: those of all modules. ONEAC_SANITIZE_FILTER is handed on as --gtest_filter,
# ONEAC_SANITIZE_JOBS bounds the number of compilers (default: all cores).
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../apps/setup.sh"

install_packages build test
cd "$oneac_root"
build=build/asan-ubsan
export CMAKE_BUILD_PARALLEL_LEVEL="${ONEAC_SANITIZE_JOBS:-$(nproc)}"

# Beyond the defaults: a view of a local that outlives it, a string that does not end, a global
# that is read before it is set.
ASAN_OPTIONS="detect_leaks=1:detect_stack_use_after_return=1:strict_string_checks=1"
ASAN_OPTIONS+=":check_initialization_order=1"
export ASAN_OPTIONS
export UBSAN_OPTIONS="print_stacktrace=1"

programs=("$@")
if [ $# -eq 0 ]; then
  mapfile -t programs < <(sed -n 's/^oneac_test(\([a-z_]*\).*/\1/p' modules/*/CMakeLists.txt)
fi
stopped=()
for program in "${programs[@]}"; do
  build_preset asan-ubsan "$program" | tail -n 1
  folder=$(dirname "$(find "$build/modules" -name "$program" -type f)")
  echo "oneac: $program"
  (cd "$folder" && "./$program" --gtest_brief=1 --gtest_filter="${ONEAC_SANITIZE_FILTER:-*}") ||
    stopped+=("$program")
done
if [ ${#stopped[@]} -gt 0 ]; then
  echo "oneac: stopped by a sanitizer or failed: ${stopped[*]}" >&2
  exit 1
fi
