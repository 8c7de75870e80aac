#!/bin/sh
# usage: links.sh PROGRAM: fails when the program is linked with the engine's libraries.
set -eu
libraries="$(ldd "$1")"
if echo "$libraries" | grep -E 'lib(epoxy|EGL|GL|OpenGL|GLdispatch|ceres|Bullet|LinearMath|assimp|opencv)'; then
  echo "$1 is linked with libraries of the engine" >&2
  exit 1
fi
