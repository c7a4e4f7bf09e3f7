#!/usr/bin/env bash
# Builds oneac on a fresh Debian 12 and runs it.
#   bash apps/demo.sh                   simulates a street drive and computes its trajectory
#   bash apps/demo.sh LOG.rawlog ...    runs your own log; further arguments go to "oneac run"
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

install_packages build
quietly build_preset release oneac
oneac="$oneac_root/build/release/apps/oneac/oneac"

if [ $# -gt 0 ]; then
  log=$1
  shift
  for argument in "$@"; do
    case $argument in -o | --output | --output=*) exec "$oneac" run "$log" "$@" ;; esac
  done
  exec "$oneac" run "$log" -o "$(basename "${log%.rawlog}")_oneac" "$@"
fi

out="${ONEAC_DEMO_DIR:-$oneac_root/demo}"
"$oneac" simulate -o "$out/drive"
"$oneac" run "$out/drive/simulated.rawlog" -o "$out/result"
echo "trajectory: $out/result/trajectory_camera.kitti"
echo "summary:    $out/result/summary.json"
echo "report:     $out/result/report.html"
