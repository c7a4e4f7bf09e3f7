#!/usr/bin/env bash
# --version, manual pages and completion of the built program:
#   bash program_test.sh PROGRAM SOURCE_DIR
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/expect.sh"
program=$1
root=$2

case_name "--version says release and commit"
run "$program" --version
expect_code 0
grep -qE '^[0-9]+\.[0-9]+\.[0-9]+ \((unknown|[-0-9a-z.]+)\)$' "$run_output" || fail "another form"

# commit_of FOLDER: what would be built in, on stdout.
commit_of() {
  cat >"$scratch/commit.cmake" <<SCRIPT
include("$root/cmake/OneacCommit.cmake")
oneac_commit(commit "$1")
message(STATUS "commit=\${commit}")
SCRIPT
  cmake -P "$scratch/commit.cmake" | sed -n 's/^-- commit=//p'
}

case_name "the commit is that of the checkout, and unknown outside"
mkdir -p "$scratch/checkout/tarball"
[ "$(commit_of "$scratch/checkout")" = unknown ] || fail "a folder without git"
git -C "$scratch/checkout" init -q
git -C "$scratch/checkout" -c user.name=a -c user.email=a@b.c commit -q --allow-empty -m first
[ "$(commit_of "$scratch/checkout")" = \
  "$(git -C "$scratch/checkout" rev-parse --short=9 HEAD)" ] || fail "not the commit"
git -C "$scratch/checkout" tag v1.2.3
[ "$(commit_of "$scratch/checkout")" = v1.2.3 ] || fail "not the tag"
[ "$(commit_of "$scratch/checkout/tarball")" = unknown ] || fail "somebody else's checkout"

case_name "each verb has a manual page that man reads without a warning"
bash "$root/apps/manual.sh" "$program" "$scratch/man"
verbs=$("$program" --help | awk '/^[^ ]/ { inside = /^Subc/ } inside && /^  [^ ]/ { print $1 }')
[ -n "$verbs" ] || fail "no verbs"
for verb in $verbs; do
  grep -q '^\.SH OPTIONS' "$scratch/man/oneac-$verb.1" || fail "oneac-$verb.1"
  grep -qF "oneac\\-$verb" "$scratch/man/oneac.1" || fail "oneac.1 does not name $verb"
done
for page in "$scratch"/man/*.1; do
  grep -q '^\.SH NAME' "$page" || fail "$page has no name"
  if command -v groff >/dev/null; then
    run groff -K utf8 -man -ww -Tutf8 -z "$page"
    [ ! -s "$run_output" ] || fail "$page"
  fi
done

# complete WORD...: what bash would offer for the last word.
complete_words() {
  COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
  _oneac
  echo " ${COMPREPLY[*]} " >"$run_output"
}

case_name "completion offers verbs and flags"
oneac() { "$program" "$@"; }
source "$root/apps/completion.bash"
complete_words oneac r
expect_output " run "
complete_words oneac run --cal
expect_output " --calibration "
complete_words oneac import k
expect_output " kitti "
complete_words oneac import kitti --copy
expect_output " --copy-images "
complete_words oneac run some.raw
expect_output "  " # file names: bash's own
