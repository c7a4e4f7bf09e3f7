#!/usr/bin/env bash
# Runs clang-tidy 14 with the checks of .clang-tidy; a finding is an error.
#   tests/tidy.sh            on what differs from main (committed or not)
#   tests/tidy.sh --all      on every source file
#   tests/tidy.sh FILE...    on these
# Nothing is compiled: the preset "clang" is only configured, for its compile_commands.json.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../apps/setup.sh"

install_packages build test check
cd "$oneac_root"
[ -f build/clang/compile_commands.json ] || cmake --preset clang >/dev/null

case ${1:-} in
  --all) mapfile -t files < <(git ls-files '*.cpp') ;;
  "") mapfile -t files < <(git diff --name-only --diff-filter=d "$(git merge-base HEAD main)" -- \
    '*.cpp') ;;
  *) files=("$@") ;;
esac

# Files of other projects (examples that are built after installing) are in no database.
known=$(grep '"file":' build/clang/compile_commands.json)
checked=()
for file in "${files[@]}"; do
  if grep -qF "/$file\"" <<<"$known"; then checked+=("$file"); else echo "not built here: $file"; fi
done
[ ${#checked[@]} -gt 0 ] || exit 0
printf '%s\0' "${checked[@]}" |
  xargs -0 -n 1 -P "${ONEAC_TIDY_JOBS:-$(nproc)}" clang-tidy-14 --quiet -p build/clang
echo "clang-tidy: ${#checked[@]} files without a finding"
