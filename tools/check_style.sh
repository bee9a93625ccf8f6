#!/usr/bin/env bash
# clang-tidy on the source files that differ from the branch's start (or from the last commit, where there is none).
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
cd "$project"

base="$(git merge-base HEAD origin/HEAD 2>/dev/null || git rev-parse -q --verify HEAD~1 || true)"
if [ "$base" = "$(git rev-parse HEAD)" ]; then base="$(git rev-parse -q --verify HEAD~1 || true)"; fi
if [ -z "$base" ]; then
  echo "no earlier commit to compare with: no file is checked" >&2
  exit 0
fi
mapfile -t files < <(git diff --name-only --diff-filter=d "$base" -- 'src/*.cpp')
if [ ${#files[@]} -eq 0 ]; then exit 0; fi
if [ ! -f build/release/compile_commands.json ]; then
  cmake --preset release -DCMAKE_EXPORT_COMPILE_COMMANDS=ON >&2
fi
printf '%s\n' "${files[@]}" | xargs -P2 -n4 clang-tidy -p build/release --quiet
