#!/usr/bin/env bash
# Draws docs/scenarios/SCENARIO.jpg: day, evening, rain and emergency, each from 15, 30 and 60 m.
#   scripts/sheets/contact_sheet.sh RUNS [SCENARIO...]
# RUNS is a folder of scripts/sheets/scenario_runs.sh. Needs the target scenario_sheet.
set -euo pipefail
root="$(cd "$(dirname "$0")/../.." && pwd)"
runs="${1:?usage: scripts/sheets/contact_sheet.sh RUNS [SCENARIO...]}"
shift
scenarios=("$@")
[ $# -gt 0 ] || mapfile -t scenarios < <(cd "$root/scenarios" && dirname -- */everyday.blueprint.json)
mkdir -p "$root/docs/scenarios"
for scenario in "${scenarios[@]}"; do
  "$root/build/release/scripts/sheets/scenario_sheet" "$root/docs/scenarios/$scenario.jpg" "${WIDTH:-480}" \
    "$scenario/everyday" "$runs/${scenario}_everyday/work/run000/trace.h5" \
    "$scenario/emergency" "$runs/${scenario}_emergency/work/run000/trace.h5"
  echo "docs/scenarios/$scenario.jpg"
done
