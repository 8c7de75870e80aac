#!/usr/bin/env bash
# Draws docs/places/PLACE.jpg: day, evening, rain and emergency, each from 15, 30 and 60 m.
#   scripts/sheets/contact_sheet.sh RUNS [PLACE...]
# RUNS is a folder of scripts/sheets/place_runs.sh. Needs the target place_sheet.
set -euo pipefail
root="$(cd "$(dirname "$0")/../.." && pwd)"
runs="${1:?usage: scripts/sheets/contact_sheet.sh RUNS [PLACE...]}"
shift
places=("$@")
[ $# -gt 0 ] || mapfile -t places < <(cd "$root/scenarios" && dirname -- */everyday.place.json)
mkdir -p "$root/docs/places"
for place in "${places[@]}"; do
  "$root/build/release/scripts/sheets/place_sheet" "$root/docs/places/$place.jpg" "${WIDTH:-480}" \
    "$place/everyday" "$runs/${place}_everyday/work/run000/trace.h5" \
    "$place/emergency" "$runs/${place}_emergency/work/run000/trace.h5"
  echo "docs/places/$place.jpg"
done
