#!/usr/bin/env bash
# compare_workflow.sh ONEAC SOURCE_DIR SNAKEMAKE: the workflow's merged files are those of one
# uninterrupted run, and a second call finds nothing to do.
set -euo pipefail
oneac=$1 source=$2 snakemake=$3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
export XDG_CACHE_HOME="$folder/cache" HOME="$folder"

"$oneac" simulate -o one --frames 6 --width 320 --height 240 --focal 250 >/dev/null
"$oneac" simulate -o two --frames 5 --width 320 --height 240 --focal 250 --seed 2 >/dev/null
mv one/simulated.rawlog one/first.rawlog
mv two/simulated.rawlog two/second.rawlog
logs=(one/first.rawlog two/second.rawlog)
methods="--initialisers 1ac_pooled,1ac_ground"

run_workflow() {
  "$snakemake" -s "$source/workflows/compare/Snakefile" --cores 2 --nocolor --config \
    logs="[${logs[0]},${logs[1]}]" program="$oneac" shards=3 output=merged arguments="$methods"
}
run_workflow >workflow.log 2>&1 || { cat workflow.log; exit 1; }
# shellcheck disable=SC2086  # two words are meant
"$oneac" compare "${logs[@]}" -o whole $methods --quiet >/dev/null
cmp whole/pairs.csv merged/pairs.csv
for file in timings.csv summary.csv table.md table.tex report.html; do test -s "merged/$file"; done

run_workflow >again.log 2>&1
grep -q "Nothing to be done" again.log || { cat again.log; exit 1; }
echo "workflow: $(($(wc -l <merged/pairs.csv) - 1)) rows, the same as in one run"
