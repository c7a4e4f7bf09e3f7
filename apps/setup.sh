# Sourced by demo.sh and tests/run.sh: installs missing packages, configures once, builds.
# A second call finds everything in place and starts in seconds.

oneac_root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
# One checkout's objects serve another: ccache sees paths relative to the checkout.
export CCACHE_BASEDIR="$oneac_root" CCACHE_NOHASHDIR=1

# as_root COMMAND...: runs it as root, through sudo when needed.
as_root() {
  if [ "$(id -u)" -eq 0 ]; then
    "$@"
  elif command -v sudo >/dev/null; then
    sudo "$@"
  else
    echo "oneac: packages are missing and there is neither root nor sudo: $*" >&2
    return 1
  fi
}

# any_installed NAME|NAME...: whether one of these packages is.
any_installed() {
  local package
  for package in ${1//|/ }; do
    if dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q "install ok installed"; then
      return 0
    fi
  done
  return 1
}

# first_available NAME|NAME...: the first that this release has; the first of all, which apt will
# name as missing, where it has none.
first_available() {
  local package
  for package in ${1//|/ }; do
    if apt-cache show --no-all-versions "$package" >/dev/null 2>&1; then
      echo "$package"
      return 0
    fi
  done
  echo "${1%%|*}"
}

# install_packages USE...: installs the packages of packages.txt with one of these uses.
install_packages() {
  local wanted missing names
  wanted=$(awk -v uses=" $* " '$1 !~ /^#/ && NF == 2 && index(uses, " " $1 " ") { print $2 }' \
    "$oneac_root/apps/packages.txt")
  missing=""
  for names in $wanted; do
    any_installed "$names" || missing="$missing $names"
  done
  [ -z "$missing" ] && return 0
  as_root apt-get update -qq
  missing=$(for names in $missing; do printf ' %s' "$(first_available "$names")"; done)
  echo "oneac: installing$missing"
  # shellcheck disable=SC2086  # one word per package is meant
  as_root env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends $missing >/dev/null
}

# configure_preset PRESET [FLAG...]: when there is no build folder yet.
configure_preset() {
  local preset=$1 log
  shift
  [ ! -f "$oneac_root/build/$preset/build.ninja" ] || return 0
  log=$(mktemp)
  (cd "$oneac_root" && cmake --preset "$preset" "$@") >"$log" 2>&1 || {
    cat "$log" >&2
    rm -f "$log"
    return 1
  }
  rm -f "$log"
}

# build_preset PRESET [TARGET...]: configures, then builds.
build_preset() {
  local preset=$1
  shift
  configure_preset "$preset" || return
  (cd "$oneac_root" && cmake --build --preset "$preset" ${1:+--target "$@"})
}

# find_real_drives: exports the folder of the real drives, ONEAC_REAL_DATA (default: ../shared/data);
# fails where it does not hold them.
find_real_drives() {
  export ONEAC_REAL_DATA="${ONEAC_REAL_DATA:-$oneac_root/../shared/data}"
  [ -d "$ONEAC_REAL_DATA/malaga-07" ] && [ -d "$ONEAC_REAL_DATA/kitti-03" ]
}

# quietly COMMAND...: runs it and prints its last line; what failed, when it fails.
quietly() {
  local log failed=0
  log=$(mktemp)
  "$@" >"$log" 2>&1 || failed=1
  if [ "$failed" -eq 0 ]; then
    tail -n 1 "$log"
  elif grep -q '^FAILED:' "$log"; then
    sed -n '/^FAILED:/,$p' "$log" | head -n 100 >&2
  else
    tail -n 40 "$log" >&2
  fi
  rm -f "$log"
  return "$failed"
}
