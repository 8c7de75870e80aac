#!/usr/bin/env bash
# Prints the Debian packages that built programs need at run time: the owners of the shared
# libraries they are linked with, the GL libraries that throng opens by name, and a font for plans.
# usage: scripts/runtime_packages.sh build/release/cli/throng build/release/libexec/throng/*
set -euo pipefail

# The package of a library. Links of update-alternatives belong to nobody, so follow them; dpkg may
# know a file by its place before or after Debian merged /lib into /usr/lib.
owner() {
  local file
  file="$(readlink -f "$1")"
  dpkg-query -S "$file" 2>/dev/null || dpkg-query -S "${file#/usr}"
}

libraries="$(ldd "$@" | sed -n 's/.*=> \(\/[^ ]*\) .*/\1/p')"
{
  for library in $libraries; do owner "$library"; done | sed 's/:.*//'
  printf '%s\n' ca-certificates curl fonts-dejavu-core libegl1 libegl-mesa0 libgl1-mesa-dri libopengl0
} | sort -u
