#!/usr/bin/env bash
# Downloads a public drive, checks it where its checksum is known, and unpacks it.
#   bash datasets/fetch.sh                               lists what there is
#   bash datasets/fetch.sh malaga-07 [FOLDER]            into FOLDER, by default ./malaga-07
#   bash datasets/fetch.sh malaga-07 FOLDER --from URL   the archive from elsewhere, file:// too
# An interrupted download goes on where it stopped when the same command is run again.
# Exit codes: 0 done, 1 failed while working, 2 wrong usage, no network or a wrong checksum.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
manifest="${ONEAC_MANIFEST:-$here/manifest.txt}"

# fail CODE TEXT: one line, as the program itself would say it.
fail() {
  echo "oneac: $2" >&2
  exit "$1"
}

# column NAME N: the N-th column of a data set's line.
column() {
  awk -F ' *[|] *' -v name="$1" -v n="$2" '$1 == name { print $n }' "$manifest"
}

list() {
  echo "usage: fetch.sh NAME [FOLDER] [--from URL]"
  awk -F ' *[|] *' '/^[^#]/ && NF { printf "  %-16s %s\n", $1, $6 }' "$manifest"
}

# transfer URL FILE [resume]: one attempt, going on at the end of FILE if asked to.
transfer() {
  if command -v curl >/dev/null; then
    curl --fail --location --retry 3 --connect-timeout 20 --progress-bar ${3:+-C -} -o "$2" "$1"
  elif command -v wget >/dev/null; then
    wget ${3:+-c} --tries 3 --timeout 20 -O "$2" "$1"
  else
    fail 2 "neither curl nor wget: install one of them"
  fi
}

# download URL FILE: FILE.part until it is whole.
download() {
  local url=$1 part=$2.part code=0
  if [ -s "$part" ]; then
    echo "going on after $(stat -c %s "$part") bytes"
    transfer "$url" "$part" resume || code=$?
    case $code in
      0) ;;
      33 | 36)  # curl's codes for a server that cannot resume: from the beginning
        rm -f "$part"
        transfer "$url" "$part" || return 1
        ;;
      *) return 1 ;;
    esac
  else
    transfer "$url" "$part" || return 1
  fi
  mv "$part" "$2"
}

# check_archive FILE SHA256
check_archive() {
  local found
  found=$(sha256sum "$1" | awk '{ print $1 }')
  if [ "$2" = - ]; then
    echo "sha256 $found (the publishers state none to compare with)"
  elif [ "$found" != "$2" ]; then
    fail 2 "$1: sha256 is $found, not $2; delete it and run again"
  else
    echo "sha256 as stated"
  fi
}

# unpack ARCHIVE FOLDER
unpack() {
  case $1 in
    *.zip)
      if command -v unzip >/dev/null; then
        unzip -q -o "$1" -d "$2"
      elif command -v cmake >/dev/null; then
        (cd "$2" && cmake -E tar xf "$1")
      else
        python3 -m zipfile -e "$1" "$2"
      fi
      ;;
    *) tar -xf "$1" -C "$2" ;;
  esac
}

# check_files NAME FOLDER: the files whose checksums are known, wherever the archive has put them.
check_files() {
  local sum file path bad=0
  [ -f "$here/$1.sha256" ] || return 0
  while read -r sum file; do
    path=$(find "$2" -name "$file" -type f -print -quit)
    if [ -z "$path" ]; then
      echo "oneac: $file is not in the archive" >&2
      bad=1
    elif [ "$(sha256sum "$path" | awk '{ print $1 }')" != "$sum" ]; then
      echo "oneac: $path differs from the file that oneac was tried with" >&2
      bad=1
    fi
  done <"$here/$1.sha256"
  [ "$bad" -eq 1 ] || echo "files as known"
}

next_steps() {
  local log
  log=$(find "$1" -name '*.rawlog' -type f -print | sort | head -n 1)
  if [ -n "$log" ]; then
    echo "next: oneac info $log"
  else
    echo "no rawlog in $1: see \"oneac import --help\""
  fi
}

main() {
  local name="" folder="" from=""
  while [ $# -gt 0 ]; do
    case $1 in
      --from)
        [ $# -ge 2 ] || fail 2 "--from wants a URL"
        from=$2
        shift
        ;;
      -h | --help)
        list
        exit 0
        ;;
      -*) fail 2 "unknown flag $1" ;;
      *) if [ -z "$name" ]; then name=$1; elif [ -z "$folder" ]; then folder=$1; else
        fail 2 "one NAME and one FOLDER, not also $1"
      fi ;;
    esac
    shift
  done
  if [ -z "$name" ]; then
    list
    exit 0
  fi
  local page archive url
  page=$(column "$name" 6)
  [ -n "$page" ] || fail 2 "no data set $name; \"fetch.sh\" alone lists them"
  url=${from:-$(column "$name" 2)}
  [ "$url" != - ] || fail 2 "$name has to be fetched by hand: $page"

  mkdir -p "${folder:=$name}"
  folder=$(cd "$folder" && pwd)
  archive=$folder/$(basename "$url")
  echo "$name: $(column "$name" 5) licence, $page"
  if [ ! -f "$archive" ]; then
    download "$url" "$archive" ||
      fail 2 "cannot get $url: no network, or it has moved. Run again to go on, or get $(basename \
        "$url") by hand from $page, put it into $folder and run again"
  fi
  check_archive "$archive" "$(column "$name" 4)"
  unpack "$archive" "$folder" ||
    fail 1 "$archive cannot be unpacked: delete it and run again"
  check_files "$name" "$folder"
  next_steps "$folder"
}

main "$@"
