#!/usr/bin/env bash
# Builds the Debian package into build/package: bash apps/package.sh
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

install_packages build package
cd "$oneac_root"
# Always configured: the package says which commit it was built from.
cmake --preset release -B build/package -DCMAKE_INSTALL_PREFIX=/usr >build/package-configure.log || {
  cat build/package-configure.log >&2
  exit 1
}
quietly cmake --build build/package
rm -f build/package/*.deb
(cd build/package && cpack >cpack.log 2>&1) || {
  cat build/package/cpack.log >&2
  exit 1
}
ls -1 "$oneac_root"/build/package/*.deb
