#!/usr/bin/env bash
# Prints the Debian packages that a built throng needs at run time: the owners of the shared
# libraries it is linked with, and the software GL driver that is loaded by name.
# usage: scripts/runtime_packages.sh build/release/cli/throng
set -euo pipefail
{
  ldd "$1" | sed -n 's/.*=> \(\/[^ ]*\) .*/\1/p' | while read -r library; do
    # Debian 12 reaches /lib through a link; dpkg knows either name.
    dpkg-query -S "$library" 2>/dev/null || dpkg-query -S "${library#/usr}" 2>/dev/null ||
      dpkg-query -S "/usr$library"
  done | sed 's/:.*//'
  printf '%s\n' ca-certificates curl libegl1 libegl-mesa0 libgl1-mesa-dri libopengl0
} | sort -u
