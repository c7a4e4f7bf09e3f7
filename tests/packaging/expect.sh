# Sourced by the tests of this folder: runs programs and compares what they say.
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
run_output="$scratch/output.txt"

case_name() {
  current_case=$1
  echo "-- $1"
}

fail() {
  echo "FAILED: $current_case: $1" >&2
  [ ! -f "$run_output" ] || cat "$run_output" >&2
  exit 1
}

# run COMMAND...: keeps its exit code, and its output of both kinds.
run() {
  run_code=0
  "$@" >"$run_output" 2>&1 || run_code=$?
}

expect_code() {
  [ "$run_code" -eq "$1" ] || fail "exit code $run_code, not $1"
}

expect_output() {
  grep -qF -- "$1" "$run_output" || fail "no \"$1\" in the output"
}
