#!/usr/bin/env bash
# Makes the manual pages from what the program says itself:
#   bash apps/manual.sh PROGRAM FOLDER     writes FOLDER/oneac.1 and FOLDER/oneac-VERB.1
set -euo pipefail
program=$1
folder=$2
mkdir -p "$folder"
rm -f "$folder"/oneac*.1
version=$("$program" --version | awk '{ print $1 }')

# page NAME WORD...: the manual page of `oneac WORD...` on stdout.
page() {
  local name=$1
  shift
  "$program" "$@" --help | awk -v name="$name" -v command="oneac${*:+ $*}" -v version="$version" '
    function plain(text) {  # as typed: no hyphenation, no roff commands
      gsub(/\\/, "\\e", text); gsub(/-/, "\\-", text)
      gsub(/,/, ",\\:", text)  # a long list of choices may go on in the next line
      return text ~ /^[.\047]/ ? "\\&" text : text
    }
    NR == 1 {
      summary = $0
      sub(/\.$/, "", summary)
      printf ".TH %s 1 \"\" \"oneac %s\" \"oneac\"\n", toupper(name), version
      printf ".SH NAME\n%s \\- %s\n", plain(name), plain(summary)
      next
    }
    /^Usage: / {
      sub(/^Usage: [^ ]*(oneac)?( |$)/, "")
      verb = command
      sub(/^oneac ?/, "", verb)
      if (verb != "" && index($0, verb) == 1) $0 = substr($0, length(verb) + 2)
      printf ".SH SYNOPSIS\n.B %s\n%s\n", plain(command), plain($0)
      next
    }
    /^[^ ].*:$/ { sub(/:$/, ""); printf ".SH %s\n", toupper($0); next }
    /^  [^ ]/ {  # "  flag VALUE      what it does"
      sub(/^  /, "")
      cut = match($0, /  +/)
      head = cut ? substr($0, 1, cut - 1) : $0
      printf ".TP\n.B %s\n", plain(head)
      if (cut) print plain(substr($0, cut + RLENGTH))
      next
    }
    { sub(/^ +/, ""); if ($0 != "") print plain($0) }
  '
  printf '.SH EXIT STATUS\n0 done, 1 failed while working, 2 wrong usage or unreadable input.\n'
}

# pages WORD...: the page of `oneac WORD...` after those of its verbs; the main page comes last and
# stands for all of them in the build.
pages() {
  local name verb verbs
  name=$(IFS=-; echo "oneac${*:+-$*}")
  verbs=$("$program" "$@" --help |
    awk '/^[^ ]/ { inside = /^Subcommands/ } inside && /^  [^ ]/ { print $1 }')
  for verb in $verbs; do pages "$@" "$verb"; done
  {
    page "$name" "$@"
    [ -z "$verbs" ] || printf '.SH SEE ALSO\n'
    for verb in $verbs; do printf '.BR %s\\-%s (1)\n' "${name//-/\\-}" "$verb"; done
  } >"$folder/$name.new"
  mv "$folder/$name.new" "$folder/$name.1"
}
pages
