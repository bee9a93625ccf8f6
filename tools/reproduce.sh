#!/usr/bin/env bash
# Makes every figure and table of README and paper again, into build/reproduce, and prints what differs from what is kept.
# Usage: tools/reproduce.sh [--list] [--keep] [NAME...]   --keep: what comes out is kept; MYOTACT: the program, else it is built
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

install_missing "$project/tools/packages-reproduce.txt"
if [ -z "${MYOTACT:-}" ]; then
  MYOTACT="$project/build/release/src/app/myotact"
  case " $* " in *" --list "*) ;; *) install_missing "$project/tools/packages.txt"; build release -- myotact ;; esac
fi
export PYTHONDONTWRITEBYTECODE=1
exec /usr/bin/python3 "$project/tools/reproduce/reproduce.py" "$MYOTACT" "$project/build/reproduce" "$@"
