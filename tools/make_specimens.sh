#!/bin/sh
# Makes meshes/canine_forelimb again from the figures in assets/canine. The same machine gives the same bytes.
# Usage: tools/make_specimens.sh [BUILD_FOLDER]      (build myotact-prepare first; default folder: build)
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
prepare=${1:-$root/build}/tools/prepare/myotact-prepare
if [ ! -x "$prepare" ]; then
  echo "$prepare: is not there; build it: cmake -S $root -B ${1:-$root/build} && cmake --build ${1:-$root/build} --target myotact-prepare" >&2
  exit 66
fi
exec "$prepare" loft "$root/assets/canine" -o "$root/meshes/canine_forelimb"
