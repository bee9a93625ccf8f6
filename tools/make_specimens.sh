#!/bin/sh
# Makes lofted limbs anew from the figures in assets/canine: the whole forelimb and hindlimb, as far as one elliptical
# centreline describes their muscles, into OUTPUT. The same machine gives the same bytes. The limbs in meshes/ hold the
# seven muscles of the elbow and were made before neighbouring muscles were parted.
# Usage: tools/make_specimens.sh OUTPUT [BUILD_FOLDER]      (build myotact-prepare first; default folder: build)
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
output=${1:?name the folder to write}
prepare=${2:-$root/build}/tools/prepare/myotact-prepare
if [ ! -x "$prepare" ]; then
  echo "$prepare: is not there; build it: cmake -S $root -B ${2:-$root/build} && cmake --build ${2:-$root/build} --target myotact-prepare" >&2
  exit 66
fi
for limb in forelimb hindlimb; do
  "$prepare" loft "$root/assets/canine/$limb.json" -o "$output/canine_$limb"
done
