#!/usr/bin/env bash
# install_test.sh BUILD SOURCE: what "cmake --install" leaves runs from anywhere, without sources and build folder.
set -euo pipefail
build="$1" source="$2"
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
fail() { echo "FAILED: $*" >&2; exit 1; }

prefix="$folder/a prefix with spaces"
cmake --install "$build" --prefix "$prefix" >/dev/null
DESTDIR="$folder/staged" cmake --install "$build" --prefix /usr >/dev/null
[ -x "$folder/staged/usr/bin/myotact" ] || fail "DESTDIR is not heeded"

# Moved to another place, called from another folder, with nothing of this environment but the search path.
mv "$prefix" "$folder/moved there"
prefix="$folder/moved there"
mkdir "$folder/elsewhere"
cd "$folder/elsewhere"
run() { env -i PATH=/usr/bin:/bin HOME="$folder" "$@"; }
run "$prefix/bin/myotact" --version >text
grep -q '^[0-9]' text || fail "no version"
run "$prefix/bin/myotact" run plane --seconds 0.1 --out out >/dev/null || fail "a scene does not run"
[ -s out/samples.csv ] || fail "a run leaves no samples.csv"
run "$prefix/bin/myotact" lesson >text
grep -q co_contraction text || fail "the lessons are not found"
run "$prefix/bin/myotact" validate --filter activation_rise >/dev/null || fail "the validation cases are not found"

# Without its data it says so, and does not look at the sources (whose path, when short, no search below would find: it can
# stand in the instructions).
mv "$prefix/share/myotact" "$folder/away"
status=0
run "$prefix/bin/myotact" run plane --out out 2>message >/dev/null || status=$?
[ "$status" = 66 ] || fail "without data the status is $status, not 66"
grep -q MYOTACT_DATA_DIR message || fail "the message names no remedy: $(cat message)"
run MYOTACT_DATA_DIR="$folder/away" "$prefix/bin/myotact" lesson >/dev/null || fail "MYOTACT_DATA_DIR is not heeded"

for program in "$prefix"/bin/*; do
  for path in "$build" "$source"; do
    if grep -qF "$path" "$program"; then fail "$program holds the path $path"; fi
  done
  page="$prefix/share/man/man1/$(basename "$program").1.gz"
  [ -s "$page" ] || fail "$program has no manual page"
  zcat "$page" | sed 's/\\-/-/g' >text
  grep -q '^\.SH EXIT STATUS' text || fail "$page is cut off"
  complaints="$(man --warnings -E UTF-8 -l -Tutf8 "$page" 2>&1 >/dev/null || true)"
  [ -z "$complaints" ] || fail "$page: $complaints"
  # Every option that --help lists, under its name; a table of names read by column must not cut one off.
  for option in $("$program" --help | grep -oE '^  (-.,)?--[a-z-]+' | grep -oE -- '--[a-z-]+'); do
    grep -q -- "$option" text || fail "$page lacks $option"
  done
done
if command -v desktop-file-validate >/dev/null; then
  desktop-file-validate "$prefix/share/applications/myotact.desktop" || fail "the desktop entry"
fi
[ -s "$folder/staged/usr/lib/udev/rules.d/70-myotact.rules" ] || fail "the rules of udev are not there"
for icon in "$prefix"/share/icons/hicolor/*/apps/myotact.*; do [ -s "$icon" ] || fail "$icon is empty"; done
for file in doc/myotact/LICENSE doc/myotact/copyright doc/myotact/README.md doc/myotact/docs/window.md metainfo/myotact.metainfo.xml; do
  [ -s "$prefix/share/$file" ] || fail "share/$file is not there"
done
echo "installed, moved and run: $(du -sh "$prefix" | cut -f1) of programs, $(du -sh "$folder/away" | cut -f1) of data"
