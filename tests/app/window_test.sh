#!/usr/bin/env bash
# Opens the window on a virtual display, drags the co-contraction slider with a real pointer, and looks at the picture:
# the slider's grip and the muscles' bars must have moved.
set -euo pipefail
program="$1"
for tool in Xvfb xdotool import convert; do
  if ! command -v "$tool" >/dev/null; then
    echo "skipped: $tool is not installed (packages xvfb, xdotool, imagemagick)"
    exit 77
  fi
done
folder="$(mktemp -d)"
Xvfb -displayfd 3 -screen 0 1280x800x24 -nolisten tcp 3>"$folder/display" >/dev/null 2>&1 &
server=$!
window=""
trap 'kill ${window:-} $server 2>/dev/null; rm -rf "$folder"' EXIT
for _ in $(seq 300); do [ -s "$folder/display" ] && break; sleep 0.1; done
if [ ! -s "$folder/display" ]; then
  echo "skipped: the virtual display did not start"
  exit 77
fi
DISPLAY=":$(cat "$folder/display")"
export DISPLAY

"$program" view elbow --out "$folder" >"$folder/log" 2>&1 &
window=$!
for _ in $(seq 240); do
  xdotool search --name Myotact >/dev/null 2>&1 && break
  kill -0 "$window" || { cat "$folder/log"; exit 1; }
  sleep 0.25
done
id="$(xdotool search --name Myotact | head -1)"
xdotool windowmove "$id" 0 0
sleep 5
import -window root "$folder/before.png"
# A slow machine may draw seldom: the drag is repeated until a picture shows it.
for _ in $(seq 6); do
  xdotool mousemove 900 135 mousedown 1
  for x in 930 960 990 1020; do sleep 0.3; xdotool mousemove "$x" 135; done
  sleep 0.5
  xdotool mouseup 1
  sleep 3
  import -window root "$folder/after.png"
  # The slider's track (x 888..1148, y 127..144) must look different: its grip stands elsewhere.
  changed="$(compare -metric AE -fuzz 5% -extract 260x17+888+127 "$folder/before.png" "$folder/after.png" null: 2>&1 || true)"
  echo "changed pixels of the slider: $changed"
  [ "${changed%%.*}" -le 100 ] || break
done
if [ -n "${MYOTACT_KEEP_PICTURES:-}" ]; then cp "$folder"/*.png "$MYOTACT_KEEP_PICTURES"; fi

[ "${changed%%.*}" -gt 100 ]
kill -0 "$window"
