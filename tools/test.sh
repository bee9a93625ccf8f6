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

phase "packages" install_missing "$project/tools/packages.txt" "$project/tools/packages-test.txt"
if [ "${1:-}" = "--quick" ]; then
  phase "release, build" build release
  phase "release, unit and physics tests" run_tests release -L 'unit|physics' -LE 'slow|bench'
  exit
fi
phase "release, build" build bundled
phase "release, tests" run_tests bundled -LE 'bench|soak'
phase "page of a class" "$project/tools/test_web.sh" "$project/build/bundled/src/app/myotact"
phase "address sanitizer, build" build asan
# The slow tests and the validation cases ran above, and what these call is tested here too.
phase "address sanitizer, tests" run_tests asan -LE "bench|$release_only"
