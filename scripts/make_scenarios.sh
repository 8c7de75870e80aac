#!/usr/bin/env bash
# Regenerates the scenarios of the library from their blueprints (scenarios/*/*.place.json). usage:
# scripts/make_scenarios.sh [THRONG]
set -euo pipefail
cd "$(dirname "$0")/.."
throng="${1:-build/release/cli/throng}"
for blueprint in scenarios/*/*.place.json; do
  "$throng" scenario make "$blueprint" -o "$(dirname "$blueprint")"
done
