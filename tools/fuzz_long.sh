#!/usr/bin/env bash
# A million random inputs for every reader, or for those that are named: for a release. Some hours; see
# tests/fuzz/README.md for what earlier runs found.
set -euo pipefail
exec "$(dirname "${BASH_SOURCE[0]}")/fuzz.sh" -runs=1000000 "$@"
