#!/usr/bin/env bash
# slurm_workflow.sh ONEAC SOURCE_DIR SNAKEMAKE: the workflow as jobs of a real Slurm, by the profile
# of workflows/slurm. One job is requeued by Slurm while it runs, one is killed and submitted anew
# by Snakemake; both go on from their journals, and the merged files are those of one run.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/slurm.sh"
[ "$1" = --contained ] || { contained bash "$0" --contained "$@"; exit; }
oneac=$2 source=$3 snakemake=$4 folder=${folder:?by contained}
pairs=10 # of each of three shards
arguments="--initialisers 5pc --trials 300" # some 0.4 s a pair

fail() {
  echo "workflow: $*" >&2
  cat "$folder/workflow.log" >&2 || true
  tail -n 20 "$folder"/{munged,slurmctld,slurmd}.log "$folder"/.snakemake/log/slurm-* >&2 || true
  exit 1
}

run_workflow() {
  CI=true timeout --signal=KILL 120 "$snakemake" -s "$source/workflows/compare/Snakefile" \
    --profile "$source/workflows/slurm" --nocolor --config logs="[drive/simulated.rawlog]" \
    program="$oneac" shards=3 output=merged arguments="$arguments"
}

journal() { echo "merged/shards/$1/journal-${1}of3.jsonl"; }
pairs_in() { { grep -s '"pair":' "$1" || true; } | wc -l; }
has_begun() { [ "$(pairs_in "$(journal "$1")")" -ge 2 ]; }
job_of() { squeue --noheader --name="oneac-shard-shard=$1" --format=%A; }
field() { scontrol show job -o "$1" | grep -o " $2=[^ ]*" | cut -d= -f2; }
has_stopped() { case $(field "$1" JobState) in RUNNING | COMPLETING) false ;; esac }

# stopped_midway SHARD JOB: keeps what the journal holds then.
stopped_midway() {
  wait_until 30 has_stopped "$2" || fail "job $2 goes on"
  cp "$(journal "$1")" "before-$1"
  [ "$(pairs_in "before-$1")" -lt "$pairs" ] || fail "shard $1 was through before it was killed"
}

# continued SHARD: the journal begins with the whole lines that it held then, times included.
continued() {
  local bytes
  bytes=$(head -n "$(wc -l <"before-$1")" "before-$1" | wc -c)
  cmp -n "$bytes" "before-$1" "$(journal "$1")" || fail "shard $1 began anew"
}

# without_times SUMMARY: its last three columns depend on the clock.
without_times() { rev "$1" | cut -d, -f4- | rev; }

cd "$folder"
export XDG_CACHE_HOME="$folder/cache" HOME="$folder"
unset SNAKEMAKE_PROFILE
start_slurm "$folder" || fail "Slurm does not start"

"$oneac" simulate -o drive --frames $((3 * pairs + 1)) --width 320 --height 240 --focal 250 \
  >/dev/null
run_workflow >workflow.log 2>&1 &
workflow=$!
wait_until 60 has_begun 0 || fail "shard 0 does not begin"
wait_until 60 has_begun 1 || fail "shard 1 does not begin"
requeued=$(job_of 0)
killed=$(job_of 1)
scontrol requeue "$requeued" || fail "job $requeued is not requeued"
scancel "$killed" || fail "job $killed is not cancelled"
stopped_midway 1 "$killed" # before Snakemake looks again
stopped_midway 0 "$requeued"
# Slurm would wait two minutes before it starts a requeued job; within a second it refuses to.
scontrol update "JobId=$requeued" StartTime=now+3 || fail "job $requeued does not wait"
# shellcheck disable=SC2086  # several words are meant
"$oneac" compare drive/simulated.rawlog -o whole $arguments --quiet >/dev/null
wait "$workflow" || fail "the workflow fails"

cmp whole/pairs.csv merged/pairs.csv || fail "pairs.csv differs"
cmp <(without_times whole/summary.csv) <(without_times merged/summary.csv) ||
  fail "summary.csv differs"
continued 0
continued 1
[ "$(field "$requeued" Restarts)" = 1 ] || fail "job $requeued was not requeued"
[ "$(field "$requeued" JobState)" = COMPLETED ] || fail "job $requeued did not end well"
[ "$(field "$killed" JobState)" = CANCELLED ] || fail "job $killed was not killed"
# Three shards, one of them twice, and the merging: what Slurm requeues is not submitted as well.
submitted=$(grep -c Submitted workflow.log)
[ "$submitted" = 5 ] || fail "$submitted jobs were submitted"
# A job that Slurm does not know, and a controller that does not answer.
status="$source/workflows/slurm/status.sh"
[ "$("$status" 12345)" = failed ] || fail "an unknown job is waited for"
mkdir away && ln -s "$(type -P false)" away/squeue
[ "$(PATH="$folder/away:$PATH" "$status" "$requeued")" = running ] || fail "silence is a failure"

echo "workflow: $(($(wc -l <merged/pairs.csv) - 1)) rows by $submitted jobs of Slurm"
