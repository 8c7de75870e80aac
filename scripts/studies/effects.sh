#!/usr/bin/env bash
# Costs of lenses, sensors, weather and props: CPU-milliseconds per image of the city square by
# `throng run --profile`, 1920 x 1080, a drone at 30 m that looks down 45 degrees, quality standard.
#   scripts/studies/effects.sh [PROGRAM]
set -euo pipefail
root="$(cd "$(dirname "$0")/../.." && pwd)"
throng="${1:-$root/build/release/cli/throng}"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT

# measure NAME CAMERA ENVIRONMENT PROPS: each is what stands between the braces in the job.
measure() {
  cat > "$work/job.json" <<JOB
{"name": "effects", "scenario": "city_square/nearest_exit", "quality": "standard",
 "drones": [{"id": "a", "start": [0, -25, 30],
   "camera": {"width": 1920, "height": 1080, "hfov_deg": 70, "pitch_deg": -45, "yaw_deg": 90$2}}],
 "capture": {"rate_hz": 4, "from_s": 5, "to_s": 7.75}, "environment": {$3}, "props": {$4},
 "outputs": {"annotations": ["coco"], "previews": 0}}
JOB
  rm -rf "$work/out"
  local ms
  ms="$("$throng" run "$work/job.json" -o "$work/out" --profile 2>&1 | awk '/^all of/ {print $5}')"
  printf '%-34s%8s\n' "$1" "$ms"
}

lens=', "model": "brown_conrady", "distortion": {"k1": -0.28, "k2": 0.07}'
printf '%-34s%8s\n' "standard, 260 people" "CPU ms"
measure "no props" '' '' '"density": 0'
measure "with props (the rest has them)" '' '' ''
measure "lens" "$lens" '' ''
measure "fisheye" ', "model": "fisheye", "distortion": {"k1": 0.02}' '' ''
measure "noise, vignette" ', "sensor": {"iso": 800, "vignette": 1}' '' ''
measure "motion blur 1/60 s" ', "sensor": {"exposure_s": 0.0167}' '' ''
measure "rolling shutter 30 ms" ', "sensor": {"readout_s": 0.03}' '' ''
measure "overcast" '' '"weather": "overcast"' ''
measure "fog" '' '"weather": "fog"' ''
measure "rain" '' '"weather": "rain"' ''
measure "night" '' '"time_of_day": "22:30"' ''
measure "smoke" '' '"smoke": 1' ''
