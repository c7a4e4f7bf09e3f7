#!/usr/bin/env bash
# Makes the API reference, build/docs/html/index.html; fails at the first kind of warning left.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../apps/setup.sh"

install_packages docs
cd "$oneac_root"
mkdir -p build/docs
doxygen docs/Doxyfile
echo "$oneac_root/build/docs/html/index.html"
