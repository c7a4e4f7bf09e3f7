#!/usr/bin/env bash
# Builds everything and runs every test; extra arguments go to ctest.
# The real drives are tested where ONEAC_REAL_DATA (default: ../shared/data) holds them.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../apps/setup.sh"

install_packages build test
# Files together: two fifths of the compiler's runs. Whoever edits has `cmake --preset dev`.
configure_preset dev -DONEAC_BUILD_TOGETHER=ON
quietly build_preset dev

without_data=()
if ! find_real_drives; then
  echo "oneac: no drives in $ONEAC_REAL_DATA: the tests on real data are not run"
  without_data=(--label-exclude real_data)
fi
ctest --test-dir "$oneac_root/build/dev" --output-on-failure --no-tests=error -j "$(nproc)" \
  "${without_data[@]}" "$@"
