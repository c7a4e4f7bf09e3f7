#!/usr/bin/env bash
# Counts the lines of modules that their unit tests run; fails where a module has less than 90 %.
#   tests/coverage.sh [MODULE...]      default: solvers geometry robust rawlog
# ONEAC_COVERAGE_JOBS bounds the number of compilers. A page per file, with the lines that no test
# runs: build/coverage/html/index.html
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../apps/setup.sh"

install_packages build check
cd "$oneac_root"
export CMAKE_BUILD_PARALLEL_LEVEL="${ONEAC_COVERAGE_JOBS:-$(nproc)}"
modules=("$@")
[ $# -gt 0 ] || modules=(solvers geometry robust rawlog)
least=90

programs=()
for module in "${modules[@]}"; do
  mapfile -t -O "${#programs[@]}" programs < <(
    sed -n 's/^ *oneac_test(\([a-z_]*\).*/\1/p' "modules/$module/CMakeLists.txt")
done
quietly build_preset coverage "${programs[@]}"

# Counts of earlier runs would be added to.
find build/coverage -name '*.gcda' -delete
for program in "${programs[@]}"; do
  path=$(find build/coverage/modules -name "$program" -type f)
  (cd "$(dirname "$path")" && "./$program" --gtest_brief=1)
done

# Lines count: what the compiler adds for exceptions and inlining has no line of its own.
counted() {
  gcovr --root . --object-directory build/coverage --exclude-unreachable-branches \
    --exclude-throw-branches --gcov-ignore-parse-errors "$@" build/coverage/modules
}
mkdir -p build/coverage/html
counted --filter 'modules/[a-z_]*/(src|include)/' --html-details build/coverage/html/index.html \
  >/dev/null

echo "| module | lines | run by the tests | % |"
echo "|---|---|---|---|"
low=()
for module in "${modules[@]}"; do
  row=$(counted --filter "modules/$module/(src|include)/" | awk '/^TOTAL/ { print $2, $3, $4 }')
  read -r lines run percent <<<"$row"
  echo "| \`$module\` | $lines | $run | ${percent%\%} |"
  [ "${percent%\%}" -ge "$least" ] || low+=("$module")
done
if [ ${#low[@]} -gt 0 ]; then
  echo "oneac: below $least %: ${low[*]}" >&2
  exit 1
fi
