#!/usr/bin/env bash
# Builds the Debian packages myotact and myotact-prepare and prints where they are. Two builds of one commit by the same
# compiler give the same bytes. Usage: tools/package.sh [PRESET]      (default: release)
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

install_missing "$project/tools/packages.txt"
preset="${1:-release}"
"$project/tools/build_web.sh"
build "$preset" -- myotact-manual myotact-prepare-manual
SOURCE_DATE_EPOCH="${SOURCE_DATE_EPOCH:-$(git -C "$project" log -1 --format=%ct 2>/dev/null || date +%s)}"
export SOURCE_DATE_EPOCH
(cd "$project/build/$preset" && umask 022 && cpack >&2)
ls "$project/build/$preset"/packages/*.deb
