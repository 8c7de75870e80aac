#!/usr/bin/env bash
# Installs what throng needs, builds it and the character library. Quick when nothing has changed. Without the packages, tests
# and benchmarks of scripts/test.sh, unless that has run here before.
# usage: scripts/setup.sh [--first]   --first: only what the first dataset needs: `throng_first` and a third of the characters
set -euo pipefail
# shellcheck source=scripts/lib.sh
. "$(dirname "$0")/lib.sh"
targets=(throng_programs throng_first) program="$built_throng" people_count=96
case "${1:-}" in
  "") ;;
  --first) targets=(throng_first) program="$first_throng" people_count=32 ;;
  *) echo "unknown argument $1; usage: scripts/setup.sh [--first]" >&2; exit 2 ;;
esac
mkdir -p "$root/build"
install_packages program

# The data of the characters comes while the program is compiled.
fetch_assets >"$root/build/assets.log" 2>&1 &
assets=$!
say "building"
if grep -qs '^BUILD_TESTING:BOOL=ON' "$root/build/release/CMakeCache.txt"; then
  build release "${targets[@]}"
else
  build release "${targets[@]}" -DBUILD_TESTING=OFF -DTHRONG_BENCHMARKS=OFF
fi
wait "$assets" || { cat "$root/build/assets.log" >&2; exit 1; }
bake_people "$program" "$people_count"
