#!/usr/bin/env bash
# Every test in release by g++, then by clang under the address and undefined-behaviour sanitizers. --quick: only the
# unit and physics tests, in release. Benchmarks and the soak run by ctest's labels only: bench, soak.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

case "${1:-}" in
  "" | --quick) ;;
  *)
    echo "usage: tools/test.sh [--quick]" >&2
    exit 2
    ;;
esac

install_missing "$project/tools/packages.txt" "$project/tools/packages-test.txt"
build release
if [ "${1:-}" = "--quick" ]; then
  exec ctest --test-dir "$project/build/release" -j2 --output-on-failure -L 'unit|physics' -LE 'slow|bench'
fi
ctest --test-dir "$project/build/release" -j2 --output-on-failure -LE 'bench|soak'
build asan
# Timing means nothing under sanitizers; the slow tests and the validation cases ran above, and what these call is
# tested here too.
exec ctest --test-dir "$project/build/asan" -j2 --output-on-failure -LE 'bench|slow|realtime|validation'
