#!/bin/sh
# The table of docs/benchmarks/calibration.md: simulated drives, calibrated from wrong cameras.
# Usage: calibration_table.sh PATH_OF_ONEAC FOLDER [SEED...]      (half an hour and more)
# Prints one line per drive and start: seed, route, start, then what `oneac calibrate` says.
set -eu
oneac=$1
folder=$2
shift 2
[ $# -gt 0 ] || set -- 1
mkdir -p "$folder"

# $1: file, $2: focal length [px], $3: k1
camera() {
  printf '[CAMERA_PARAMS]\nresolution = [640 480]\ncx = 319.5\ncy = 239.5\nfx = %s\nfy = %s\n' \
    "$2" "$2" > "$1"
  printf 'dist = [%s 0 0 0 0]\n' "$3" >> "$1"
}

# $1: drive, $2: name of the start, $3: focal length [px], $4: k1
calibrate() {
  out=$folder/$1-$2
  mkdir -p "$out"
  camera "$out/start.ini" "$3" "$4"
  "$oneac" calibrate "$folder/$1/simulated.rawlog" -o "$out/camera.ini" --no-progress \
    --calibration "$out/start.ini" > "$out/said.txt"
  printf '%s | %s | ' "$1" "$2"
  grep -v -e '^written' -e '^camera' "$out/said.txt" | tr '\n' '|'
  echo
}

for seed in "$@"; do
  "$oneac" simulate -o "$folder/street-$seed" --frames 300 --seed "$seed" > "$folder/simulate.txt"
  for start in -10:450 -5:475 -2:490 +2:510 +5:525 +10:550; do
    calibrate "street-$seed" "f${start%%:*}" "${start##*:}" 0
  done
  calibrate "street-$seed" k1-0.15 500 -0.15
  calibrate "street-$seed" k1+0.15 500 0.15
done
"$oneac" simulate -o "$folder/straight" --route straight --frames 300 > "$folder/simulate.txt"
calibrate straight f+5 525 0
