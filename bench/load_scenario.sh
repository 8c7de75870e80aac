#!/usr/bin/env bash
# How long a scenario with 500 buildings and 10 000 people takes until its first step is simulated: from the start of the
# program to the end of a run of 0.1 s, the least of three. Also for the ids given, of shipped scenarios.
#   bench/load_scenario.sh [ID...]
# THRONG names another program than build/release/cli/throng.
set -euo pipefail
root="$(cd "$(dirname "$0")/.." && pwd)"
throng="${THRONG:-$root/build/release/cli/throng}"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT

python3 - "$work/town.blueprint.json" <<'PY'
import json, sys
columns, rows, pitch, size = 25, 20, 18.0, 10.0
wide, deep = columns * pitch, rows * pitch
buildings = [{"id": f"b{i}_{j}", "box": [i * pitch, j * pitch, i * pitch + size, j * pitch + size],
              "height_m": 6 + (i * 7 + j * 3) % 9} for i in range(columns) for j in range(rows)]
json.dump({
    "name": "Town of 500 buildings",
    "ground": {"min": [-40, -40], "max": [wide + 40, deep + 40], "material": "asphalt"},
    "inside": {"min": [-20, -20], "max": [wide + 12, deep + 12]},
    "exits": [{"id": "west", "from": [-12, 100], "to": [-12, 108]},
              {"id": "east", "from": [wide + 4, 100], "to": [wide + 4, 108]}],
    "buildings": buildings,
    "drones": [{"id": "d1", "start": [100, 100, 40]}],
    "people": {"groups": [{"doing": "cross", "box": [-6, -6, wide - 2, deep - 2], "count": 10000}]},
}, open(sys.argv[1], "w"))
PY
"$throng" scenario make "$work/town.blueprint.json" -o "$work" > /dev/null

# seconds FOLDER ID
seconds() {
  printf '{"scenario": "%s", "capture": {"rate_hz": 10, "from_s": 0, "to_s": 0.1}}' "$2" > "$work/job.json"
  for _ in 1 2 3; do
    THRONG_SCENARIOS="$1" bash -c 'TIMEFORMAT="%R %U"; time "$@" > /dev/null 2>&1' _ "$throng" simulate "$work/job.json" \
      -o "$work/trace.h5"
  done 2>&1 | sort -n | head -1
}

printf '%-32s %s\n' scenario 'seconds (wall, CPU of the program)'
printf '%-32s %s\n' 'town: 500 buildings, 10 000' "$(seconds "$work" town)"
for id in "$@"; do
  printf '%-32s %s\n' "$id" "$(seconds "$root/scenarios" "$id")"
done
