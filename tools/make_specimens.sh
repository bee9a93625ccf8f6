#!/bin/sh
# Makes the limbs in meshes/ again from the figures in assets/canine: canine_forelimb, about 140 tets a muscle, and
# canine_forelimb_fine, about 250. The same machine gives the same bytes.
# Usage: tools/make_specimens.sh [BUILD_FOLDER]      (build myotact-prepare first; default folder: build)
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
prepare=${1:-$root/build}/tools/prepare/myotact-prepare
if [ ! -x "$prepare" ]; then
  echo "$prepare: is not there; build it: cmake -S $root -B ${1:-$root/build} && cmake --build ${1:-$root/build} --target myotact-prepare" >&2
  exit 66
fi
"$prepare" loft "$root/assets/canine" -o "$root/meshes/canine_forelimb"
"$prepare" loft "$root/assets/canine" -o "$root/meshes/canine_forelimb_fine" --tets 350
