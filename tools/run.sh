#!/usr/bin/env bash
# Installs what is missing, builds, and opens the window. Without a display it runs the elbow and leaves a picture, a
# stiffness plot and tables in out/ of the present folder. Arguments are passed on: tools/run.sh --seconds 2
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

install_missing "$project/tools/packages.txt"
build release -- myotact
myotact="$project/build/release/src/app/myotact"

if [ -n "${DISPLAY:-}" ] || [ -n "${WAYLAND_DISPLAY:-}" ]; then
  exec "$myotact" view "$@"
fi
"$myotact" run elbow --out out "$@"
echo "no display: the scene ran without a window and left in $PWD/out:" >&2
ls -l out >&2
