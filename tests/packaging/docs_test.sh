#!/usr/bin/env bash
# What the pages show is what is there: bash docs_test.sh SOURCE_DIR PROGRAM
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/expect.sh"
root=$1
program=$2

# shown LANGUAGE: the first block of code in that language of docs/library.md.
shown() {
  awk -v fence="\`\`\`$1" '$0 == fence && !seen { inside = seen = 1; next }
    inside && /^```/ { inside = 0 } inside' "$root/docs/library.md"
}

for pair in cpp:main.cpp cmake:CMakeLists.txt; do
  case_name "docs/library.md shows ${pair#*:}, which install_test.sh builds"
  run diff <(shown "${pair%%:*}") "$root/tests/packaging/consumer/${pair#*:}"
  expect_code 0
done

case_name "the example stays short"
[ "$(wc -l <"$root/tests/packaging/consumer/main.cpp")" -lt 60 ] || fail "60 lines or more"

case_name "docs/parameters.md is what the program says (renew: bash docs/parameters.sh PROGRAM)"
bash "$root/docs/parameters.sh" "$program" >"$scratch/parameters.md"
run diff "$scratch/parameters.md" "$root/docs/parameters.md"
expect_code 0

case_name "every relative link of a page leads to a file"
mapfile -t pages < <(cd "$root" && find README.md docs datasets -name '*.md' | sort)
for page in "${pages[@]}"; do
  grep -oE '\]\([^)#: ]+[)#]' "$root/$page" | sed 's/^](//; s/.$//' >"$run_output" || true
  while read -r target; do
    [ -e "$(dirname "$root/$page")/$target" ] || fail "$page: no $target"
  done <"$run_output"
done

case_name "the runner of blocks sees faults"
blocks() { run python3 "$root/tests/packaging/run_blocks.py" "$program" "$root" "$@"; }
printf '```bash\nfalse\n```\n' >"$scratch/fails.md"
printf '```console\n$ echo 1 word\n2 word\n$ echo other\nword\n```\n' >"$scratch/differs.md"
printf '```\noneac run x\n```\n' >"$scratch/unnamed.md"
printf '```console\n$ printf "1 a\\n2 b\\n3 c\\n"\n4 a\n...\n6 c\n```\n' >"$scratch/agrees.md"
blocks "$scratch"/{fails,differs,unnamed}.md
expect_code 1
[ "$(grep -c '^FAILED' "$run_output")" -eq 3 ] || fail "not one fault per page"
blocks "$scratch/agrees.md"
expect_code 0

case_name "every block of commands runs, or says why not, and prints what is shown"
blocks "${pages[@]/#/$root/}"
grep ' not run: ' "$run_output" || true
expect_code 0
