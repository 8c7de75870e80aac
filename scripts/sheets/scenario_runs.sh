#!/usr/bin/env bash
# Runs every scenario of the library for 60 s, everyday and emergency, with an image every 10 s, validates each dataset
# and prints a row of docs/shipped_scenarios.md for it. Finished runs are not repeated.
#   scripts/sheets/scenario_runs.sh FOLDER [SCENARIO...]
# FOLDER/PLACE_VARIANT/ are the jobs' folders; THRONG names another program than build/release/cli/throng.
set -euo pipefail
root="$(cd "$(dirname "$0")/../.." && pwd)"
throng="${THRONG:-$root/build/release/cli/throng}"
folder="${1:?usage: scripts/sheets/scenario_runs.sh FOLDER [SCENARIO...]}"
shift
scenarios=("$@")
[ $# -gt 0 ] || mapfile -t scenarios < <(cd "$root/scenarios" && dirname -- */everyday.blueprint.json)
mkdir -p "$folder"

# job SCENARIO VARIANT: the shipped job with small, few images. The demo is every day, but for scenarios with a job for that.
job() {
  local file="$2"
  [ -e "$root/scenarios/$1/$file.job.json" ] || file=demo
  jq '.capture = {rate_hz: 0.1, from_s: 0, to_s: 60} | .drones[0].camera += {width: 640, height: 360}
      | .outputs.previews = 1' "$root/scenarios/$1/$file.job.json"
}

printf '| scenario | variant | people | turned back at an exit | out after 60 s |\n|---|---|---|---|---|\n'
for scenario in "${scenarios[@]}"; do
  for variant in everyday emergency; do
    out="$folder/${scenario}_$variant"
    if [ ! -e "$out/dataset/manifest.json" ]; then
      job "$scenario" "$variant" > "$out.job.json"
      "$throng" run "$out.job.json" -o "$out" > "$out.log" 2>&1 || { tail -3 "$out.log"; exit 1; }
      "$throng" validate "$out/dataset" > "$out.validation"
    fi
    jq -r --arg scenario "$scenario" --arg variant "$variant" \
      '.runs[0] | .people_counts as $counts
        | "| \($scenario) | \($variant) | \(.people - $counts.turned_back - $counts.never_inside) | \($counts.turned_back) | \(
            $counts.left_by_no_exit + ([$counts.left_by_exit[].people] | add)) |"' \
      "$out/dataset/metrics.json"
  done
done
