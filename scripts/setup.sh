#!/usr/bin/env bash
# Installs what throng needs, builds it and the character library. Quick when nothing has changed. Without the packages, tests
# and benchmarks of scripts/test.sh, unless that has run here before.
# usage: scripts/setup.sh [--first]   --first: only what the first dataset needs: `throng` and a third of the characters
set -euo pipefail
programs=throng_programs people_count=96
case "${1:-}" in
  "") ;;
  --first) programs=throng people_count=32 ;;
  *) echo "unknown argument $1; usage: scripts/setup.sh [--first]" >&2; exit 2 ;;
esac
# shellcheck source=scripts/lib.sh
. "$(dirname "$0")/lib.sh"
mkdir -p "$root/build"
install_packages program

# The data of the characters comes while the program is compiled.
fetch_assets >"$root/build/assets.log" 2>&1 &
assets=$!
say "building"
if grep -qs '^BUILD_TESTING:BOOL=ON' "$root/build/release/CMakeCache.txt"; then
  build release "$programs"
else
  build release "$programs" -DBUILD_TESTING=OFF -DTHRONG_BENCHMARKS=OFF
fi
wait "$assets" || { cat "$root/build/assets.log" >&2; exit 1; }
bake_people "$people_count"
