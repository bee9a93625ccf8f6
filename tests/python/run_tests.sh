#!/usr/bin/env bash
# Makes the wheel, installs it in a clean virtual environment and runs the tests of this folder on what was installed.
# Usage: run_tests.sh PYTHON SOURCES BUILD [PROGRAM [PREPARE]]. Ends with 77 where a package is not there.
set -euo pipefail
python="$1" sources="$2" build="$3"
export MYOTACT_PROGRAM="${4:-}" MYOTACT_PREPARE="${5:-myotact-prepare}"
export MYOTACT_PYTHON_BUILD="$build/module"
unset MYOTACT_DATA_DIR PYTHONPATH

for module in build numpy pybind11 pytest setuptools venv wheel; do
  if ! "$python" -c "import $module" 2>/dev/null; then
    echo "skipped: $python has no $module; install the packages of tools/packages-test.txt" >&2
    exit 77
  fi
done
mkdir -p "$build"
rm -rf "$build/dist" "$build/venv" "$build/sources"
mkdir -p "$build/dist"
"$python" -m build --wheel --no-isolation --outdir "$build/dist" "$sources/python" >"$build/wheel.log" 2>&1 || {
  tail -n 40 "$build/wheel.log" >&2
  exit 1
}
"$python" -m venv --system-site-packages "$build/venv"
"$build/venv/bin/python" -m pip install --quiet --no-index --no-deps "$build"/dist/*.whl
cd "$build"  # not where a folder is called myotact
"$build/venv/bin/python" -m pytest -q -p no:cacheprovider -rs "$sources/tests/python"
