#!/usr/bin/env bash
# datasets/fetch.sh against archives on this machine: bash fetch_test.sh SOURCE_DIR
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/expect.sh"
fetch="$1/datasets/fetch.sh"

# A data set of one log, and what the manifest would say about it.
mkdir "$scratch/content" "$scratch/server"
head -c 20000 /dev/urandom >"$scratch/content/drive.rawlog"
tar -C "$scratch/content" -czf "$scratch/server/drive.tar.gz" drive.rawlog
sum=$(sha256sum "$scratch/server/drive.tar.gz" | cut -d ' ' -f 1)
url="file://$scratch/server/drive.tar.gz"
export ONEAC_MANIFEST="$scratch/manifest.txt"
cat >"$ONEAC_MANIFEST" <<MANIFEST
# comment
drive | $url | - | $sum | free | https://example.org/page
other | $url | - | ${sum//[0-9]/0} | free | https://example.org/page
unsure | $url | - | - | free | https://example.org/page
by-hand | - | - | - | free | https://example.org/page
offline | http://127.0.0.1:9/drive.zip | - | - | free | https://example.org/page
MANIFEST

case_name "downloads, checks and unpacks"
run bash "$fetch" drive "$scratch/whole"
expect_code 0
expect_output "sha256 as stated"
expect_output "oneac info $scratch/whole/drive.rawlog"
cmp "$scratch/content/drive.rawlog" "$scratch/whole/drive.rawlog" || fail "another file"

case_name "does not download what is there"
run bash "$fetch" drive "$scratch/whole" --from "file://$scratch/nowhere/drive.tar.gz"
expect_code 0

case_name "goes on after an interruption"
mkdir "$scratch/part"
head -c 1000 "$scratch/server/drive.tar.gz" >"$scratch/part/drive.tar.gz.part"
run bash "$fetch" drive "$scratch/part"
expect_code 0
expect_output "going on after 1000 bytes"
cmp "$scratch/content/drive.rawlog" "$scratch/part/drive.rawlog" || fail "another file"

case_name "really goes on: a wrong beginning stays and is found by its checksum"
mkdir "$scratch/wrong"
head -c 1000 /dev/zero >"$scratch/wrong/drive.tar.gz.part"
run bash "$fetch" drive "$scratch/wrong"
expect_code 2
expect_output "sha256 is"

case_name "refuses a wrong checksum and unpacks nothing"
run bash "$fetch" other "$scratch/other"
expect_code 2
[ ! -e "$scratch/other/drive.rawlog" ] || fail "unpacked"

case_name "says when no checksum is known"
run bash "$fetch" unsure "$scratch/unsure"
expect_code 0
expect_output "publishers state none"

case_name "says what to do without network, and keeps what it has"
mkdir "$scratch/offline"
echo begun >"$scratch/offline/drive.zip.part"
run bash "$fetch" offline "$scratch/offline"
expect_code 2
expect_output "https://example.org/page"
[ -s "$scratch/offline/drive.zip.part" ] || fail "the part is gone"

case_name "names the page of what has to be fetched by hand"
run bash "$fetch" by-hand
expect_code 2
expect_output "https://example.org/page"

case_name "knows no other data set"
run bash "$fetch" nothing
expect_code 2
expect_output "no data set nothing"

case_name "the shipped manifest has six columns, and a page for each"
unset ONEAC_MANIFEST
awk -F ' *[|] *' '/^[^#]/ && (NF != 6 || $6 !~ /^https:/) { print; bad = 1 } END { exit bad }' \
  "$1/datasets/manifest.txt" || fail "see above"
run bash "$fetch"
expect_code 0
expect_output "malaga-07"
