#!/usr/bin/env bash
# Doxygen has nothing to complain about: bash reference_test.sh SOURCE_DIR
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/expect.sh"
cd "$1"

case_name "the API reference is made without a warning"
cat docs/Doxyfile <(echo "OUTPUT_DIRECTORY = $scratch") >"$scratch/Doxyfile"
run doxygen "$scratch/Doxyfile"
[ ! -s "$run_output" ] || fail "warnings"
expect_code 0

case_name "it shows the front-end"
[ -f "$scratch/html/classoneac_1_1FrontEnd.html" ] || fail "no page of oneac::FrontEnd"
