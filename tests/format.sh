#!/usr/bin/env bash
# Fails when a source file is not as clang-format 14 would write it; --fix rewrites instead.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../apps/setup.sh"
install_packages format
cd "$oneac_root"
mode=(--dry-run --Werror)
[ "${1:-}" = "--fix" ] && mode=(-i)
git ls-files '*.h' '*.cpp' | xargs clang-format-14 "${mode[@]}"
