#!/usr/bin/env bash
# The maps of a run, as others read them: bash tracks_test.sh PROGRAM
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/expect.sh"
program=$1
check="$(dirname "${BASH_SOURCE[0]}")/check_tracks.py"
gpx=$scratch/out/trajectory.gpx
kml=$scratch/out/trajectory.kml

"$program" simulate -o "$scratch/a & b" --frames 150 --width 320 --height 240 --focal 250 \
  --no-progress >/dev/null
"$program" run "$scratch/a & b/simulated.rawlog" -o "$scratch/out" --no-progress >/dev/null

case_name "GPX and KML obey the rules of their schemas"
run python3 "$check" "$gpx" "$kml"
expect_code 0
expect_output "150 150"

# broken NAME FILE EXPRESSION: the checker refuses the file after sed's EXPRESSION.
broken() {
  case_name "the check finds $1"
  cp "$gpx" "$scratch/a.gpx"
  cp "$kml" "$scratch/a.kml"
  sed -i "$3" "$scratch/a.$2"
  run python3 "$check" "$scratch/a.gpx" "$scratch/a.kml"
  expect_code 1
}
broken "an element out of order" gpx 's|\(<ele>[^<]*</ele>\)\(<time>[^<]*</time>\)|\2\1|'
broken "a place beyond the earth" gpx 's|lat="|lat="9|'
broken "a time in another form" gpx 's|<time>\(....\)-|<time>\1/|'
broken "a style that is not there" kml 's|#way|#street|'
broken "coordinates that are none" kml 's|^ *\(-[0-9.]*\),\([0-9.]*\),|\2;\1,|'

if command -v gpsbabel >/dev/null; then
  case_name "gpsbabel reads both"
  for kind in gpx kml; do
    run gpsbabel -t -i "$kind" -f "$scratch/out/trajectory.$kind" -x transform,wpt=trk \
      -o unicsv -F "$scratch/$kind.csv"
    expect_code 0
    [ "$(wc -l <"$scratch/$kind.csv")" -eq 151 ] || fail "$(wc -l <"$scratch/$kind.csv") lines"
  done
else
  echo "-- gpsbabel is not here: the rules alone were checked"
fi
