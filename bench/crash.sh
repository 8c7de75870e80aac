#!/bin/sh
# Kills the server, workers, and both at many random moments of small jobs: bench/crash.sh [MOMENTS=50]
cd "$(dirname "$0")/.." || exit 1
THRONG_CRASHES=${1:-50} exec /usr/bin/python3 tests/cli/test_crash.py "${THRONG:-build/release/cli/throng}"
