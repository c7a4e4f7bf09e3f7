# Completion of oneac in bash: verbs and flags as the program's own --help lists them.

# _oneac_words SECTION WORD...: the names in that section of `oneac WORD... --help`.
_oneac_words() {
  local section=$1
  shift
  oneac "$@" --help 2>/dev/null | awk -v section="$section" '
    /^[^ ]/ { inside = ($0 ~ "^" section) }
    inside && /^  [^ ]/ { gsub(",", " ", $1); print $1 }'
}

_oneac() {
  local current=${COMP_WORDS[COMP_CWORD]} verbs=() word
  # The verbs so far (`import kitti` has two): what --help is asked about.
  for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
    [[ $word == -* ]] && break
    grep -qxF -- "$word" <(_oneac_words Subcommands "${verbs[@]}") || break
    verbs+=("$word")
  done
  COMPREPLY=()
  if [[ $current == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$(_oneac_words Options "${verbs[@]}")" -- "$current")
  elif [ "${#verbs[@]}" -eq $((COMP_CWORD - 1)) ]; then
    mapfile -t COMPREPLY < <(compgen -W "$(_oneac_words Subcommands "${verbs[@]}")" -- "$current")
  fi
}

# Where there is nothing to say: file names.
complete -o default -F _oneac oneac
