#!/usr/bin/env bash
# Feeds random bytes to every reader of files, of the network and of devices, two at a time: for 30 s each, or SECONDS,
# or -runs=N inputs. Ends with 1 when one crashes, leaks, hangs or breaks its promise; the bytes that did it are left in
# build/fuzz/findings/. A change gets some seconds; fuzz_long.sh is for a release.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

case "${1:-30}" in
  -runs=*) amount="$1" ;;
  *[!0-9]* | 0)
    echo "usage: tools/fuzz.sh [SECONDS | -runs=N] [TARGET...]" >&2
    exit 2
    ;;
  *) amount="-max_total_time=${1:-30}" ;;
esac
targets=("${@:2}")
if [ ${#targets[@]} -eq 0 ]; then targets=(stl obj ply off vtk_surface vtk_tets tetgen medit json opensim febio specimen lesson work marks settings recording wire local_model scene_frame inverse_messages device_bytes label_volume segment_table); fi

install_missing "$project/tools/packages.txt" "$project/tools/packages-test.txt"
build asan -- fuzz_targets

# fuzz TARGET: what it finds worth keeping goes to build/, so that the corpus in the repository stays small.
fuzz() {
  local build="$project/build/fuzz" status=0
  mkdir -p "$build/corpus/$1" "$build/findings"
  "$project/build/asan/tests/fuzz/fuzz_$1" "$amount" -seed=1 -max_len=4096 -rss_limit_mb=1024 -timeout=10 -print_final_stats=1 \
    -artifact_prefix="$build/findings/$1-" "$build/corpus/$1" "$project/tests/fuzz/corpus/$1" \
    >"$build/$1.log" 2>&1 || status=$?
  if [ "$status" -eq 0 ]; then
    echo "$1: $(sed -n 's/^stat::number_of_executed_units: *//p' "$build/$1.log") inputs, nothing found"
  else
    tail -n 60 "$build/$1.log" >&2
    echo "$1: FOUND SOMETHING; see $build/$1.log and $build/findings/" >&2
    return 1
  fi
}
export -f fuzz
export project amount
printf '%s\n' "${targets[@]}" | xargs -P2 -I{} bash -euo pipefail -c 'fuzz {}' || exit 1
