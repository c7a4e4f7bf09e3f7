#!/usr/bin/env bash
# Prints docs/parameters.md from the tables that the program itself reads parameters with:
#   bash docs/parameters.sh PROGRAM >docs/parameters.md
set -euo pipefail
cat <<'HEAD'
# Parameters

Made by `docs/parameters.sh` from what the program says (`oneac run --print-params`); a test compares. Each key is
set in a YAML file (`--params FILE`, sections nested as the dots say) or by `--set key=value`; later ones win, flags
last. An unknown key is answered with the nearest one that exists. `params.yaml` of a run holds those in effect.
HEAD
"$1" run --print-params | awk '
  {
    depth = match($0, /[^ ]/) - 1
    depth /= 2
    line = substr($0, 2 * depth + 1)
    name = line
    sub(/:.*/, "", name)
    path[depth] = name
  }
  line ~ /^[a-z_]+:$/ { next }
  {
    section = path[0]
    for (i = 1; i < depth; ++i) section = section "." path[i]
    if (section != last) {
      printf "\n## %s\n\n| key | default | unit | must be | meaning |\n|---|---|---|---|---|\n", section
      last = section
    }
    value = line
    sub(/^[^:]*: /, "", value)
    at = index(value, "# [")
    comment = substr(value, at + 3)
    value = substr(value, 1, at - 1)
    sub(/ +$/, "", value)
    close_at = index(comment, "]")
    meaning = substr(comment, close_at + 2)
    gsub(/[|]/, "\\|", meaning)
    unit = substr(comment, 1, close_at - 1)
    bound = ""
    if (comma = index(unit, ", ")) {
      bound = substr(unit, comma + 2)
      unit = substr(unit, 1, comma - 1)
    }
    printf "| `%s` | `%s` | %s | %s | %s |\n", name, value, unit, bound, meaning
  }'
