#!/usr/bin/env bash
# The programs shown in docs/library.md are the ones that install_test.sh builds:
#   bash docs_test.sh SOURCE_DIR
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/expect.sh"

# shown LANGUAGE: the page's first block of code in that language.
shown() {
  awk -v fence="\`\`\`$1" '$0 == fence && !seen { inside = seen = 1; next }
    inside && /^```/ { inside = 0 } inside' "$2/docs/library.md"
}

for pair in cpp:main.cpp cmake:CMakeLists.txt; do
  case_name "docs/library.md shows ${pair#*:}"
  run diff <(shown "${pair%%:*}" "$1") "$1/tests/packaging/consumer/${pair#*:}"
  expect_code 0
done

case_name "the example stays short"
[ "$(wc -l <"$1/tests/packaging/consumer/main.cpp")" -lt 60 ] || fail "60 lines or more"
