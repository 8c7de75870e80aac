#!/usr/bin/env bash
# Installs what throng needs, builds it and the character library. Quick when nothing has changed.
set -euo pipefail
# shellcheck source=scripts/lib.sh
. "$(dirname "$0")/lib.sh"
mkdir -p "$root/build"
install_packages
fetch_assets
say "building"
build release throng
bake_people 96
