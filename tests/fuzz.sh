#!/usr/bin/env bash
# Builds the fuzz targets with libFuzzer and runs each for SECONDS (default 60), two at once:
#   tests/fuzz.sh [SECONDS] [TARGET...]     e.g. tests/fuzz.sh 3600 rawlog_source
# ONEAC_FUZZ_RUNS=N ends a target after N inputs, too: the same inputs each time, as CI wants them.
# Starts from tests/fuzz/corpus/TARGET; new inputs and findings go to build/fuzz/found/TARGET.
# A finding goes to the corpus together with its repair, so that every test run repeats it.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../apps/setup.sh"

install_packages build test fuzz
cd "$oneac_root"
seconds=${1:-60}
shift || true
targets=("$@")
if [ $# -eq 0 ]; then
  for folder in tests/fuzz/corpus/*/; do targets+=("$(basename "$folder")"); done
fi
configure_preset fuzz -DONEAC_BUILD_TOGETHER=ON
quietly build_preset fuzz "${targets[@]/#/fuzz_}"

# is_slow PROGRAM FOLDER: whether an input took 10 s of CPU time, which is promised to none. Those
# that took 10 s of the clock are tried again: a busy machine may hold a program for longer.
is_slow() {
  local input
  for input in "$2"/finding-slow-unit-*; do
    [ -f "$input" ] || continue
    (ulimit -t 10 && "$1" "$input" >/dev/null 2>&1) || return 0
    rm "$input"
  done
  return 1
}

# fuzz TARGET: one line with what was tried; the whole log and status 1 at a finding.
fuzz() {
  local found="build/fuzz/found/$1" program="build/fuzz/tests/fuzz/fuzz_$1"
  mkdir -p "$found"
  local TIMEFORMAT='cpu_seconds: %U'
  # 1 GB is promised; the sanitizers take memory of their own.
  if ! { time "$program" -max_total_time="$seconds" -timeout=600 -report_slow_units=10 \
    -seed="${ONEAC_FUZZ_SEED:-0}" -runs="${ONEAC_FUZZ_RUNS:--1}" -malloc_limit_mb=1024 \
    -rss_limit_mb=2560 -max_len=16384 -print_final_stats=1 -artifact_prefix="$found/finding-" \
    "$found" "tests/fuzz/corpus/$1"; } >"$found.log" 2>&1 || is_slow "$program" "$found"; then
    tail -n 60 "$found.log"
    # A log is all that is left of another machine's run: `base64 -d` gives the input back.
    local input
    for input in "$found"/finding-*; do
      [ -f "$input" ] && echo "fuzz: base64 of $input: $(head -c 16384 "$input" | base64 -w 0)"
    done
    echo "fuzz: $1 has a finding, see build/fuzz/found/$1" >&2
    return 1
  fi
  awk -v target="$1" '/number_of_executed_units/ { runs = $2 } /cov:/ { cov = $4 }
    /peak_rss_mb/ { mb = $2 } /^cpu_seconds/ { cpu = $2 }
    END {
      printf "fuzz: %-15s %5d s of CPU, %9d runs, coverage %5d, %4d MB\n", target, cpu, runs, cov, mb
    }' \
    "$found.log"
}
export -f fuzz is_slow
export seconds
export UBSAN_OPTIONS="halt_on_error=1:print_stacktrace=1"
export LSAN_OPTIONS="suppressions=$oneac_root/tests/fuzz/lsan.supp:print_suppressions=0"
printf '%s\n' "${targets[@]}" | xargs -P "${ONEAC_FUZZ_JOBS:-$(nproc)}" -I '{}' bash -c 'fuzz {}'
