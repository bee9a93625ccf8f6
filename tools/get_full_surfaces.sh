#!/usr/bin/env bash
# The full surfaces of both left limbs in one command: gets the Python package dm_control (Apache-2.0) by pip, sorts its
# dog's surfaces into FOLDER/forelimb_left and FOLDER/hindlimb_left, and prepares both limbs in FOLDER/specimens. Tests
# and programs find them with MYOTACT_CANINE_DIR=FOLDER.
# Usage: tools/get_full_surfaces.sh FOLDER [--from SOURCE] [--any-version] [--sort-only]
#   --from SOURCE   a package file or a copy of dm_control that is there already: no network is needed
#   --any-version   take surfaces that differ from those which attachments were measured on
#   --sort-only     no specimens
set -euo pipefail
tools="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"

fail() {  # STATUS TEXT
  echo "error: $2" >&2
  exit "$1"
}

folder="" source="" sort_only="" any_version=()
while [ $# -gt 0 ]; do
  case "$1" in
    --from) source="${2:?--from: name a file or folder}"; shift ;;
    --any-version) any_version=(--any-version) ;;
    --sort-only) sort_only=yes ;;
    -h | --help) sed -n '2,9s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; exit 0 ;;
    -*) fail 2 "$1: is no option; the options are --from, --any-version, --sort-only" ;;
    *) [ -z "$folder" ] || fail 2 "$1: one folder only"; folder="$1" ;;
  esac
  shift
done
[ -n "$folder" ] || fail 2 "FOLDER is missing: where the surfaces are to go"
command -v python3 >/dev/null || fail 69 "python3 is not installed: apt-get install python3"

build="${MYOTACT_BUILD_DIR:-$tools/../build/release}"
prepare="$build/tools/prepare/myotact-prepare"
if [ -z "$sort_only" ] && [ ! -x "$prepare" ]; then
  fail 69 "$prepare: is not built; build it with: cmake --build $build --target myotact-prepare, or add --sort-only"
fi

if [ -z "$source" ]; then
  python3 -m pip --version >/dev/null 2>&1 || fail 69 "pip is not installed: apt-get install python3-pip"
  downloads="$(mktemp -d)"
  trap 'rm -rf "$downloads"' EXIT
  if ! python3 -m pip download --quiet --disable-pip-version-check --no-deps --dest "$downloads" dm_control >&2; then
    fail 69 "the package dm_control could not be got by pip: is there a network? Else copy the package here and name it: --from FILE"
  fi
  source="$(find "$downloads" -type f | head -n 1)"
fi

python3 "$tools/full_surfaces/sort_surfaces.py" "$source" "$folder" "${any_version[@]}"
[ -n "$sort_only" ] || "$prepare" import "$folder" -o "$folder/specimens"
echo "done. Now: export MYOTACT_CANINE_DIR=$(cd "$folder" && pwd)" >&2
