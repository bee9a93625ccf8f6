#!/usr/bin/env bash
# Builds the page that `myotact serve SCENE --web` hands to browsers: web/dist, from web/ and the packages of its lock
# file. Not a part of the ordinary build, which needs no node; what it makes is other people's code to a good part and
# stays out of the repository.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  install_missing "$project/tools/packages-web.txt"
fi
cd "$project/web"
# What a package brings to be run while it is installed is not run: none of them needs it.
if [ ! -d node_modules ] || [ package-lock.json -nt node_modules/.package-lock.json ]; then npm ci --ignore-scripts >&2; fi
npm run --silent check >&2
npm run --silent build >&2
ls -l dist >&2
