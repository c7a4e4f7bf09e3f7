#!/usr/bin/env bash
# What a script says of a build that it runs quietly: bash setup_test.sh SOURCE_DIR
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/expect.sh"
source "$1/apps/setup.sh"

case_name "says the last line of what succeeds"
run quietly printf '%s\n' first last
expect_code 0
[ "$(cat "$run_output")" = last ] || fail "more than the last line"

case_name "says the compiler's words when a build fails"
run quietly bash -c 'echo "[1/2] fine"; printf "FAILED: a.o\na.cpp:1: error\nstopped\n"; exit 1'
expect_code 1
expect_output "a.cpp:1: error"

case_name "says the end of anything else that fails"
run quietly bash -c 'echo "no such target"; exit 1'
expect_code 1
expect_output "no such target"

case_name "takes the first name of a package that the release has"
dpkg-query() { [ "${!#}" = present ] && echo "install ok installed"; }
apt-cache() { [ "${!#}" = newer ]; }
[ "$(first_available 'older|newer')" = newer ] || fail "not the one that there is"
[ "$(first_available 'older|oldest')" = older ] || fail "not the first where there is none"
any_installed 'absent|present' || fail "one is installed"
if any_installed 'absent|older'; then fail "none is installed"; fi
echo ok
