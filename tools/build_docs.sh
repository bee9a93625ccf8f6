#!/usr/bin/env bash
# Builds the site of docs/ into build/site, or the folder given. A link that leads nowhere fails, and so does a page that loads
# anything from the network. Usage: tools/build_docs.sh [FOLDER]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

install_missing "$project/tools/packages-docs.txt"
site="${1:-$project/build/site}"
case "$site" in /*) ;; *) site="$PWD/$site" ;; esac
export PYTHONDONTWRITEBYTECODE=1
/usr/bin/python3 -m mkdocs build --quiet --strict --clean --config-file "$project/mkdocs.yml" --site-dir "$site"
/usr/bin/python3 "$project/tools/docs_offline.py" "$site"
echo "$site/index.html"
