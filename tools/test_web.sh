#!/usr/bin/env bash
# Builds the page of a class and tests it: types, units with the golden frames of the wire format, and in a real browser,
# against a class without a simulation and against `myotact serve --web`. Usage: tools/test_web.sh PROGRAM. Leaves out,
# with a message, what node, npm or chromium is missing for.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  echo "page of a class: not tested, there is no node or npm here (tools/packages-web.txt)" >&2
  exit 0
fi
"$project/tools/build_web.sh"
program="$(realpath "$1")"
cd "$project/web"
npm test --silent
if ! command -v "${CHROMIUM:-chromium}" >/dev/null; then
  echo "page of a class: not tested in a browser, there is no chromium here" >&2
  exit 0
fi
MYOTACT="$program" npm run --silent test:browser
