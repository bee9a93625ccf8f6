#!/bin/sh
# Makes the embedded specimens anew: plane, plate, pad, particle and spring; both whole limbs from their volumes in
# assets/canine. The same machine gives the same bytes. meshes/canine_elbow, canine_forelimb and canine_hindlimb were
# lofted from the measured sections before there were volumes, and are kept as they are: tests and figures rest on them.
# The lines of canine_elbow are those that `loft elbow.json` gives today; its forepaw is the whole forelimb's.
# Usage: tools/make_specimens.sh [BUILD_FOLDER [OUTPUT]]      (build all first; default: build meshes)
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
build=${1:-$root/build}
output=${2:-$root/meshes}
prepare=$build/tools/prepare/myotact-prepare
if [ ! -x "$prepare" ]; then
  echo "$prepare: is not there; build it: cmake -S $root -B $build && cmake --build $build --target myotact-prepare" >&2
  exit 66
fi
myotact=$build/src/app/myotact
if [ ! -x "$myotact" ]; then
  echo "$myotact: is not there; build it: cmake --build $build --target myotact" >&2
  exit 66
fi
whole() {
  "$prepare" "$root/assets/canine/$1.seg.nrrd" --recipe "$root/assets/canine/$1.json" -o "$output/canine_whole_$1"
  rm "$output/canine_whole_$1/report.html" "$output/canine_whole_$1/recipe.json" # a report is no source, the recipe is in assets
}
whole forelimb
whole hindlimb
for specimen in canine_whole_forelimb canine_whole_hindlimb; do
  MYOTACT_DATA_DIR=$root "$myotact" calibrate "$output/$specimen" > /dev/null # the last digits are a processor's
done
[ ! -d "$output/canine_elbow" ] || python3 "$root/tools/elbow_paw.py" "$output"
"$build/tools/plain_specimens/myotact-plain-specimens" "$output"
