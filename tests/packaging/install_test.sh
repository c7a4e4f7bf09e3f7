#!/usr/bin/env bash
# Installs the build tree, moves what was installed, and builds and runs programs against it:
#   bash install_test.sh BUILD_DIR SOURCE_DIR
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/expect.sh"
build=$1
tests="$2/tests/packaging"
oneac="$scratch/moved/bin/oneac"

# build_against_moved PROJECT: configures and builds it in the scratch folder.
build_against_moved() {
  run cmake -S "$tests/$1" -B "$scratch/$1" -DCMAKE_BUILD_TYPE=Release -DCONSUMER_LOOPS=ON \
    -DCMAKE_PREFIX_PATH="$scratch/moved" -DCMAKE_CXX_FLAGS="-Wall -Wextra -Werror"
  expect_code 0
  run cmake --build "$scratch/$1"
  expect_code 0
}

case_name "installs nothing where only the program was built"
needs="$build/oneac_install_needs.cmake"
[ -s "$needs" ] || fail "no list of what an install needs"
archive=$(tr ';"' '\n\n' <"$needs" | grep liboneac_base.a)
mv "$archive" "$archive.away"
run cmake --install "$build" --prefix "$scratch/half"
mv "$archive.away" "$archive"
expect_code 1
expect_output "cmake --build"
[ ! -e "$scratch/half" ] || fail "installed half of it"

case_name "installs into a prefix, which then moves"
run cmake --install "$build" --prefix "$scratch/first"
expect_code 0
mv "$scratch/first" "$scratch/moved"
for file in bin/oneac include/oneac/frontend/front_end.h share/oneac/params/default.yaml \
  share/doc/oneac/copyright share/bash-completion/completions/oneac \
  share/oneac/datasets/fetch.sh; do
  [ -f "$scratch/moved/$file" ] || fail "$file is not installed"
done

case_name "writes no path of the source, the build or the first prefix"
config=$(dirname "$(find "$scratch/moved" -name oneacConfig.cmake)")
run grep -rlF -e "$2" -e "$build" -e "$scratch/first" "$config"
expect_code 1

case_name "keeps sources, tests and internal headers at home"
run find "$scratch/moved" -name '*.cpp' -o -name '*_test*' -o -path '*/src/*'
[ ! -s "$run_output" ] || fail "installed too much"

case_name "the moved program runs"
run "$oneac" --version
expect_code 0
run "$oneac" simulate -o "$scratch/drive" --frames 12 --width 320 --height 240 --focal 250
expect_code 0

case_name "find_package(oneac) serves a program of one's own"
build_against_moved consumer
run "$scratch/consumer/consumer" "$scratch/drive/simulated.rawlog" "$scratch/drive/Images" 1.65
expect_code 0
[ "$(grep -cE '^[0-9.]+( -?[0-9]+\.[0-9]+){7}$' "$run_output")" -eq 12 ] || fail "not 12 poses"
[ "$(wc -l <"$run_output")" -eq 12 ] || fail "more than poses"

case_name "a program of one's own closes loops as oneac run does"
run "$oneac" simulate -o "$scratch/block" --route block --laps 2 --block-m 40 --lane-shift-m 0.5 \
  --width 320 --height 240 --focal 250
expect_code 0
run "$oneac" run "$scratch/block/simulated.rawlog" -o "$scratch/closed" --loops --camera-height 1.5
expect_code 0
[ "$(wc -l <"$scratch/closed/loops.csv")" -gt 10 ] || fail "hardly any loops"
run sh -c '"$1" "$2" 1.5 >"$3"' - "$scratch/consumer/closed_drive" \
  "$scratch/block/simulated.rawlog" "$scratch/closed_drive.tum"
expect_code 0
expect_output " loops"
# To a millimetre: the program doubts lengths by what the whole drive says of the camera.
run awk 'NR == FNR { x[FNR] = $2; z[FNR] = $4; next }
  { n++; far = far || ($2 - x[FNR]) ^ 2 + ($4 - z[FNR]) ^ 2 > 1e-6 }
  END { exit far || n != length(x) }' \
  "$scratch/closed_drive.tum" "$scratch/closed/keyframes_optimised.tum"
expect_code 0

case_name "it ends as well where maps begin anew, at frames that were no keyframes"
run "$oneac" simulate -o "$scratch/dark" --frames 24 --night --scenery far --road dark \
  --width 320 --height 240 --focal 250
expect_code 0
run "$scratch/consumer/closed_drive" "$scratch/dark/simulated.rawlog" 1.5
expect_code 0
expect_output "0 loops"

case_name "every module can be found, included and linked"
build_against_moved all_modules
run "$scratch/all_modules/all_modules"
expect_code 0

if [ -d "$build/python/oneac" ]; then
  case_name "the moved Python package is imported, with its types"
  package=$(find "$scratch/moved" -path '*/dist-packages/oneac' -type d)
  for file in py.typed _oneac.pyi _solvers.pyi; do
    [ -f "$package/$file" ] || fail "$file is not installed"
  done
  run env PYTHONPATH="$(dirname "$package")" /usr/bin/python3 -B -c 'import oneac
print(oneac.__file__, oneac.relpose_1ac_ground([0, 0.3], [0, 0.4], [[1.3, 0], [0, 1.8]]).t[0])'
  expect_code 0
  expect_output "$package/__init__.py"
fi
