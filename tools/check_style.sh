#!/usr/bin/env bash
# clang-format on all sources; clang-tidy on those that differ from the branch's start (or from the last commit, where
# there is none), each without precompiled headers, so that it must include what it uses.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
cd "$project"

git ls-files -z -- '*.cpp' '*.h' | xargs -0 -P2 -n64 clang-format --dry-run --Werror

base="$(git merge-base HEAD origin/HEAD 2>/dev/null || git rev-parse -q --verify HEAD~1 || true)"
if [ "$base" = "$(git rev-parse HEAD)" ]; then base="$(git rev-parse -q --verify HEAD~1 || true)"; fi
if [ -z "$base" ]; then
  echo "no earlier commit to compare with: clang-tidy sees no file" >&2
  exit 0
fi
mapfile -t files < <(git diff --name-only --diff-filter=d "$base" -- 'src/*.cpp' 'tools/*.cpp' 'tests/*.cpp' ':!tests/fuzz')
if [ ${#files[@]} -eq 0 ]; then exit 0; fi
cmake --preset clang -B build/tidy -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON >&2
printf '%s\n' "${files[@]}" | xargs -P2 -n4 clang-tidy -p build/tidy --quiet
