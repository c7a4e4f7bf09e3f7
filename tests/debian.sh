#!/usr/bin/env bash
# The two commands of README.md on a bare Debian: bash tests/debian.sh SUITE [FOLDER]
#   SUITE    bookworm, trixie, forky ...
#   FOLDER   where the root (5 GB) is made and removed again; default: TMPDIR, or /tmp
#   ONEAC_DEBIAN_CCACHE=DIR   compiled objects are kept there; without it all is compiled anew
#   ONEAC_DEBIAN_KEEP=1       the root stays, and is used by the next call with the same FOLDER
#   ONEAC_DEBIAN_RUN=COMMAND  runs this in the clone instead of the two commands
# Needs root. The mirror and its settings are those of this machine's apt.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../apps/setup.sh"

# mirror_of_apt: the address that apt has the main archive of Debian from.
mirror_of_apt() {
  apt-get indextargets --format '$(LABEL) $(SITE)' | awk '$1 == "Debian" { print $2; exit }'
}

# apt_settings: what this machine's apt was told about the network.
apt_settings() {
  apt-config dump | grep -E '^Acquire::(https?::|Check-|Retries)' || true
}

# proxy_of_apt SCHEME: as debootstrap wants it, which asks no apt.
proxy_of_apt() {
  local proxy=""
  eval "$(apt-config shell proxy "Acquire::$1::Proxy")"
  [ "$proxy" = DIRECT ] || echo "$proxy"
}

# make_root SUITE ROOT: git, a compiler and apt. A suite that debootstrap has no script of yet is
# made as sid is, in a copy of the scripts.
make_root() {
  local scripts="$2.scripts" proxy mirror
  mirror=$(mirror_of_apt)
  [ -n "$mirror" ] || {
    echo "debian.sh: apt names no archive of Debian on this machine" >&2
    return 1
  }
  cp -r /usr/share/debootstrap "$scripts"
  [ -e "$scripts/scripts/$1" ] || ln -s sid "$scripts/scripts/$1"
  proxy=$(proxy_of_apt http)
  [ -z "$proxy" ] || export http_proxy="$proxy"
  proxy=$(proxy_of_apt https)
  [ -z "$proxy" ] || export https_proxy="$proxy"
  DEBOOTSTRAP_DIR="$scripts" in_namespace debootstrap --variant=minbase \
    --include=ca-certificates,git,g++ "$1" "$2" "$mirror" >"$2.log" 2>&1 || {
    tail -n 20 "$2.log" >&2
    return 1
  }
  apt_settings >"$2/etc/apt/apt.conf.d/90host"
}

# in_namespace COMMAND...: its mounts and its processes end with it, and it with this script.
in_namespace() {
  setpriv --pdeathsig KILL unshare --mount --pid --fork --kill-child -- "$@"
}

# in_root ROOT COMMAND: in the clone, with the environment of a fresh login.
in_root() {
  in_namespace bash -c '
    set -e
    mount -t proc proc "$1/proc"
    mount -t sysfs sysfs "$1/sys"
    mount --rbind /dev "$1/dev"
    if [ -n "$3" ]; then mount --bind "$3" "$1/ccache"; fi
    exec env -i HOME=/root LANG=C.UTF-8 PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
      ${3:+CCACHE_DIR=/ccache} chroot "$1" bash -c "cd /root/oneac && $2"
  ' - "$1" "$2" "${ONEAC_DEBIAN_CCACHE:-}"
}

# timed NAME COMMAND...: its output, then its time.
timed() {
  local name=$1
  shift
  local TIMEFORMAT="debian.sh: $suite: $name: %0R s, %0U s of CPU"
  time "$@"
}

versions() {
  in_root "$root" "dpkg-query -W -f '\${Package} \${Version}\n' g++ libeigen3-dev libopencv-dev \
    libceres-dev libmrpt-obs-dev"
}

suite=${1:?"usage: bash tests/debian.sh SUITE [FOLDER]"}
folder=${2:-${TMPDIR:-/tmp}}
[ "$(id -u)" -eq 0 ] || {
  echo "debian.sh: needs root, for debootstrap and chroot" >&2
  exit 2
}
install_packages machines
if [ -n "${ONEAC_DEBIAN_KEEP:-}" ]; then
  place="$folder/oneac-$suite"
  mkdir -p "$place"
else
  place=$(mktemp -d "$folder/oneac-$suite.XXXXXX")
  # Nothing is mounted out here; should it be, what is mounted stays.
  trap 'rm -rf --one-file-system "$place"' EXIT
  trap 'exit 130' INT TERM
fi
root="$place/root"
if [ ! -e "$root/etc/apt/apt.conf.d/90host" ]; then
  rm -rf --one-file-system "$root" "$root.scripts"
  timed "the root" make_root "$suite" "$root"
fi
mkdir -p "$root/ccache" ${ONEAC_DEBIAN_CCACHE:+"$ONEAC_DEBIAN_CCACHE"}
if [ -d "$root/root/oneac" ]; then
  git -c safe.directory='*' -C "$root/root/oneac" fetch -q "$oneac_root" HEAD
  git -c safe.directory='*' -C "$root/root/oneac" reset -q --hard FETCH_HEAD
else
  git clone -q --no-hardlinks "$oneac_root" "$root/root/oneac"
fi
if [ -n "${ONEAC_DEBIAN_RUN:-}" ]; then
  in_root "$root" "$ONEAC_DEBIAN_RUN"
  exit
fi
timed "apps/demo.sh" in_root "$root" "bash apps/demo.sh"
versions
timed "tests/run.sh" in_root "$root" "bash tests/run.sh"
