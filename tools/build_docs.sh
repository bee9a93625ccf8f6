#!/usr/bin/env bash
# Builds the site of docs/, and the paper as a page, into build/site, or the folder given. A link that leads nowhere fails,
# and so does a page that loads anything from the network. Usage: tools/build_docs.sh [FOLDER]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

install_missing "$project/tools/packages-docs.txt"
site="${1:-$project/build/site}"
case "$site" in /*) ;; *) site="$PWD/$site" ;; esac
export PYTHONDONTWRITEBYTECODE=1
/usr/bin/python3 -m mkdocs build --quiet --strict --clean --config-file "$project/mkdocs.yml" --site-dir "$site"
# The paper beside it: one file that holds its pictures.
(cd "$project/paper" && pandoc paper.md --citeproc --lua-filter numbers.lua --mathml --standalone \
  --self-contained --fail-if-warnings --to=html5 --css ../docs/paper.css --output "$site/paper.html")
/usr/bin/python3 "$project/tools/docs_offline.py" "$site"
printf '%s\n' "$site/index.html" "$site/paper.html"
