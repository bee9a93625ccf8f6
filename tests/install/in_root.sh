#!/usr/bin/env bash
# Inside the bare system that package_test.sh made: installs /debs/*.deb, uses them, removes them.
set -euo pipefail
fail() { echo "FAILED: $*" >&2; exit 1; }
apt() { apt-get -qq -o APT::Keep-Downloaded-Packages=true "$@" >/tmp/apt.log 2>&1 || fail "apt-get $*: $(tail -5 /tmp/apt.log)"; }

apt update
# First without the recommended drivers: everything but pictures has to work.
apt install -y --no-install-recommends /debs/myotact_*.deb
cd /tmp
myotact --version
myotact devices >/dev/null || fail "myotact devices"
myotact run elbow --seconds 0.5 --out /tmp/x --levels 0 >/tmp/run.log 2>&1 || fail "myotact run: $(tail -3 /tmp/run.log)"
[ "$(wc -l </tmp/x/samples.csv)" -ge 500 ] || fail "samples.csv has $(wc -l </tmp/x/samples.csv) rows"
if ldd /usr/bin/myotact | grep -E 'not found|libtet|libCGAL' >/dev/null; then fail "libraries: $(ldd /usr/bin/myotact)"; fi

apt install -y libgl1-mesa-dri
myotact run plane --seconds 0.1 --out /tmp/y --png /tmp/plane.png >/tmp/run.log 2>&1 || fail "picture: $(tail -3 /tmp/run.log)"
[ "$(head -c 8 /tmp/plane.png | od -An -tx1 | tr -d ' \n')" = 89504e470d0a1a0a ] || fail "no PNG: $(tail -3 /tmp/run.log)"

apt install -y /debs/myotact-prepare_*.deb
myotact-prepare --help >/dev/null || fail "myotact-prepare --help"
myotact-prepare check /usr/share/myotact/meshes/plate >/tmp/check.log 2>&1 || fail "check: $(tail -3 /tmp/check.log)"
for page in myotact myotact-prepare; do
  man -P cat "$page" >/tmp/page 2>&1 || fail "man $page: $(head -3 /tmp/page)"
  grep -q 'EXIT STATUS' /tmp/page || fail "man $page: $(head -3 /tmp/page)"
done
dpkg --verify myotact myotact-prepare || fail "files differ from the packages"

dpkg -L myotact myotact-prepare | sort -u >/tmp/files
dpkg --purge myotact-prepare myotact >/dev/null
# What man has kept formatted is man's.
left="$(find / -xdev -iname '*myotact*' -not -path '/var/cache/man/*' -not -path '/proc/*' -not -path '/debs/*' -not -path '/tmp/*')"
[ -z "$left" ] || fail "left behind: $left"
while read -r file; do [ -d "$file" ] || [ ! -e "$file" ] || fail "left behind: $file"; done </tmp/files
echo "installed, run, read and removed: $(wc -l </tmp/files) files and folders"
