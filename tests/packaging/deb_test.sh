#!/usr/bin/env bash
# The Debian package of the build tree, unpacked beside the system: bash deb_test.sh BUILD_DIR
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/expect.sh"

case_name "cpack makes one package"
run cpack --config "$1/CPackConfig.cmake" -B "$scratch"
expect_code 0
run find "$scratch" -maxdepth 1 -name 'oneac_*.deb'
[ "$(wc -l <"$run_output")" -eq 1 ] || fail "not one package"
package=$(cat "$run_output")

case_name "it depends on the shared libraries that the program uses, on no headers"
run dpkg-deb --field "$package" Depends
for library in libmrpt-obs2 libopencv-core libvlfeat libc6; do expect_output "$library"; done
grep -q -e '-dev' "$run_output" && fail "needs a package for developers"

case_name "it holds program, libraries, headers, configuration, parameters and papers"
run dpkg-deb --contents "$package"
for file in /usr/bin/oneac /usr/lib/oneac/oneac_rivals.so liboneac_frontend.a oneacConfig.cmake \
  /usr/include/oneac/frontend/front_end.h /usr/share/oneac/params/default.yaml \
  /usr/share/man/man1/oneac-run.1 /usr/share/bash-completion/completions/oneac \
  /usr/share/doc/oneac/copyright; do
  expect_output "$file"
done
[ ! -e "$1/apps/oneac/oneac_rosbag" ] || expect_output /usr/lib/oneac/oneac_rosbag
if [ -d "$1/python/oneac" ]; then
  expect_output /usr/lib/python3/dist-packages/oneac/_oneac.cpython
  expect_output /usr/lib/python3/dist-packages/oneac/py.typed
  [ "$(dpkg-deb --field "$package" Provides | cut -d ' ' -f 1)" = python3-oneac ] ||
    fail "does not provide python3-oneac"
fi
grep -q -v ' \./usr/' <(sed 1d "$run_output") && fail "something outside /usr"

case_name "the unpacked program runs and finds its plugin"
dpkg-deb --extract "$package" "$scratch/root"
run "$scratch/root/usr/bin/oneac" --version
expect_code 0
run "$scratch/root/usr/bin/oneac" compare --rivals no-such.rawlog -o "$scratch/out"
expect_code 2
expect_output "no-such.rawlog"

if [ -d "$1/python/oneac" ]; then
  case_name "the unpacked Python package is imported"
  run env PYTHONPATH="$scratch/root/usr/lib/python3/dist-packages" /usr/bin/python3 -B -c \
    'import oneac; print(len(oneac.solvers()), "solvers")'
  expect_code 0
  expect_output " solvers"
fi
