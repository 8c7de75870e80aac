#!/usr/bin/env bash
# Makes scenarios of every kind from seeds 1 to SEEDS and checks each as `throng scenario check` does.
#   bench/generated_scenarios.sh [SEEDS] [KIND...]
# Prints what was wrong, and at the end how many scenarios of each kind had no finding. THRONG names another program.
set -euo pipefail
root="$(cd "$(dirname "$0")/.." && pwd)"
throng="${THRONG:-$root/build/release/cli/throng}"
seeds="${1:-1000}"
shift $(($# > 0 ? 1 : 0))
kinds=("$@")
[ $# -gt 0 ] || kinds=(plaza street campus block)
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT

for kind in "${kinds[@]}"; do
  clean=0
  start=$(date +%s)
  for ((seed = 1; seed <= seeds; ++seed)); do
    "$throng" scenario generate --kind "$kind" --seed "$seed" -o "$work/$kind" > /dev/null
    if "$throng" scenario check "$work/$kind" > "$work/found" 2>&1; then
      clean=$((clean + 1))
    else
      echo "$kind $seed:"
      cat "$work/found"
    fi
    rm -rf "${work:?}/$kind"
  done
  echo "$kind: $clean of $seeds without errors, $(($(date +%s) - start)) s"
done
