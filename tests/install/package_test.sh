#!/usr/bin/env bash
# package_test.sh SOURCE PRESET: builds the packages, installs them with their dependencies into a bare Debian of their own, runs
# the programs there and removes them. Needs root and a Debian mirror, else skips (77). The bare Debian and what was
# downloaded stay in build/install_root for the next time. All mounts are in a namespace that ends with the test.
set -euo pipefail
source="$1" preset="$2"
skip() { echo "skipped: $*"; exit 77; }
fail() { echo "FAILED: $*" >&2; exit 1; }

[ "$(id -u)" = 0 ] || skip "must be root to make a system root"
command -v debootstrap >/dev/null || skip "debootstrap is not installed"
unshare --mount --pid --fork true 2>/dev/null || skip "this machine allows no mount namespaces"
. /etc/os-release
[ "${VERSION_CODENAME:-}" != "" ] || skip "not a Debian release"
mirror="$(apt-get indextargets --format '$(REPO_URI) $(CODENAME)' 'Created-By: Packages' |
  awk -v release="$VERSION_CODENAME" '$2 == release {print $1; exit}')"
[ -n "$mirror" ] || skip "apt knows no mirror of $VERSION_CODENAME; run apt-get update"
eval "$(apt-config shell http_proxy Acquire::http::Proxy)"
if [ -n "${http_proxy:-}" ]; then export http_proxy; fi

cache="$source/build/install_root"
mkdir -p "$cache/archives/partial"
base="$cache/$VERSION_CODENAME"
if [ ! -d "$base" ]; then
  rm -rf "$base.part"
  debootstrap --variant=minbase --include=man-db "$VERSION_CODENAME" "$base.part" "$mirror" >"$cache/debootstrap.log" 2>&1 ||
    skip "debootstrap failed, see $cache/debootstrap.log: $(tail -1 "$cache/debootstrap.log")"
  mv "$base.part" "$base"
  echo "made a bare $VERSION_CODENAME"
fi
root="$(mktemp -d "$cache/root.XXXXXX")"
trap 'rm -rf "$root"' EXIT
cp -a "$base/." "$root"
mkdir "$root/debs"
"$source/tools/package.sh" "$preset" >/dev/null
cp "$source/build/$preset"/packages/*.deb "$root/debs"
if [ -n "${http_proxy:-}" ]; then echo "Acquire::http::Proxy \"$http_proxy\";" >"$root/etc/apt/apt.conf.d/proxy"; fi
cp "$(dirname "$0")/in_root.sh" "$root/debs"

# shellcheck disable=SC2016  # expanded inside
env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
  unshare --mount --pid --fork bash -c '
    mount --make-rprivate / && mount -t proc proc "$1/proc" && mount --bind "$2" "$1/var/cache/apt/archives" &&
    cp /etc/resolv.conf "$1/etc/resolv.conf" && exec chroot "$1" bash /debs/in_root.sh' \
  - "$root" "$cache/archives" || fail "inside the bare system, see above"
