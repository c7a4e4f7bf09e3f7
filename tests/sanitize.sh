#!/usr/bin/env bash
# Builds the tests with sanitizers and runs them; a finding ends the program and fails the script.
#   tests/sanitize.sh asan-ubsan|tsan [TEST_PROGRAM...]    e.g. tests/sanitize.sh tsan base_test
# Without programs: the unit tests of all modules, the fuzzers' corpora, then the program itself in
# faults_test, integration_test and regression_test, with the real drives where ONEAC_REAL_DATA
# (default: ../shared/data) holds them. ONEAC_SANITIZE_FILTER is handed on as --gtest_filter,
# ONEAC_SANITIZE_JOBS bounds the number of compilers (default: all cores).
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../apps/setup.sh"

preset=${1:-}
case $preset in
  asan-ubsan | tsan) shift ;;
  *)
    echo "usage: tests/sanitize.sh asan-ubsan|tsan [TEST_PROGRAM...]" >&2
    exit 2
    ;;
esac
install_packages build test
cd "$oneac_root"
export CMAKE_BUILD_PARALLEL_LEVEL="${ONEAC_SANITIZE_JOBS:-$(nproc)}"

# Beyond the defaults: a view of a local that outlives it, a string that does not end, a global
# that is read before it is set.
rules="$oneac_root/tests/sanitizers"
ASAN_OPTIONS="detect_leaks=1:detect_stack_use_after_return=1:strict_string_checks=1"
ASAN_OPTIONS+=":check_initialization_order=1"
export ASAN_OPTIONS
export LSAN_OPTIONS="suppressions=$rules/lsan.supp:print_suppressions=0"
export UBSAN_OPTIONS="print_stacktrace=1"
export TSAN_OPTIONS="suppressions=$rules/tsan.supp:halt_on_error=1:second_deadlock_stack=1"

programs=("$@")
if [ $# -eq 0 ]; then
  mapfile -t programs < <(sed -n 's/^ *oneac_test(\([a-z_]*\).*/\1/p' modules/*/CMakeLists.txt)
  programs+=(fuzz_replay_test faults_test integration_test regression_test)
fi

filter="*"
find_real_drives || filter="*-Malaga07.*:Kitti03.*:MutatedRealLog.*"
filter="${ONEAC_SANITIZE_FILTER:-$filter}"

stopped=()
for program in "${programs[@]}"; do
  targets=("$program")
  case $program in integration_test | regression_test) targets+=(oneac) ;; esac
  quietly build_preset "$preset" "${targets[@]}"
  folder=$(dirname "$(find "build/$preset" -name "$program" -type f)")
  echo "oneac: $program ($preset)"
  (cd "$folder" && "./$program" --gtest_brief=1 --gtest_filter="$filter") ||
    stopped+=("$program")
done
if [ ${#stopped[@]} -gt 0 ]; then
  echo "oneac: stopped by a sanitizer or failed: ${stopped[*]}" >&2
  exit 1
fi
