#!/usr/bin/env bash
# Builds the Debian packages of the last commit in a bare root of their own, where nothing is but what
# tools/packages.txt names, and prints their checksums. Usage: tools/packaging/clean_root.sh [RELEASE [PRESET [FOLDER]]]
#   RELEASE   bookworm (Debian 12, the default) or noble (Ubuntu 24.04)
#   PRESET    release (the default), or bundled, which takes half the time
#   FOLDER    where the packages come to; default build/clean/RELEASE
# Needs root, debootstrap and a mirror (MIRROR=URL chooses another); else ends with 69. SOURCE_DATE_EPOCH is the
# commit's time.
# CCACHE=FOLDER takes objects from a cache of this machine, for a trial: no proof then that the place of the sources
# leaves no trace in them.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../common.sh"

release="${1:-bookworm}" preset="${2:-release}" target="${3:-$project/build/clean/${1:-bookworm}}"
cannot() { echo "$*" >&2; exit 69; }
[ "$(id -u)" = 0 ] || cannot "only root can make a bare root: sudo $0 $*"
command -v debootstrap >/dev/null || cannot "debootstrap is not there: apt-get install debootstrap"
case "$release" in
  bookworm) mirror="${MIRROR:-http://deb.debian.org/debian}" components=main script="" ;;
  # Debian's debootstrap knows Ubuntu's releases by the script of an older one.
  noble) mirror="${MIRROR:-http://archive.ubuntu.com/ubuntu}" components=main,universe script=gutsy ;;
  *) echo "there is no release $release here: bookworm, noble" >&2; exit 2 ;;
esac
keyring=()
if [ "$release" = noble ]; then
  keyring=(--keyring /usr/share/keyrings/ubuntu-archive-keyring.gpg)
  if [ ! -f "${keyring[1]}" ]; then
    [ "${UNVERIFIED:-}" = 1 ] ||
      cannot "${keyring[1]} is not there: take it from Ubuntu's package ubuntu-keyring, or set UNVERIFIED=1 for a trial"
    keyring=(--no-check-gpg)
  fi
fi

cache="$project/build/clean"
mkdir -p "$cache" "$target"
base="$cache/$release.base"
if [ ! -d "$base" ]; then
  rm -rf "$base.part"
  debootstrap "${keyring[@]}" --variant=minbase --components="$components" --include=ca-certificates \
    "$release" "$base.part" "$mirror" ${script:+"/usr/share/debootstrap/scripts/$script"} >"$cache/$release.log" 2>&1 ||
    cannot "debootstrap failed, see $cache/$release.log: $(tail -1 "$cache/$release.log")"
  mv "$base.part" "$base"
fi
root="$(mktemp -d "$cache/$release.XXXXXX")"
trap 'rm -rf "$root"' EXIT
cp -a "$base/." "$root"
# Not the place of this checkout: what a program says of it would differ.
mkdir -p "$root/build/myotact"
git -C "$project" archive HEAD | tar -x -C "$root/build/myotact"
# Behind a proxy that opens what is encrypted npm needs this machine's certificates.
cp /etc/ssl/certs/ca-certificates.crt "$root/build/certificates.crt"
epoch="$(git -C "$project" log -1 --format=%ct)"

cache_setting=(CCACHE_DISABLE=1)
if [ -n "${CCACHE:-}" ]; then
  mkdir "$root/build/ccache"
  cache_setting=(CCACHE_DIR=/build/ccache)
fi

# shellcheck disable=SC2016  # expanded inside
env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
  "${cache_setting[@]}" http_proxy="${http_proxy:-}" https_proxy="${https_proxy:-}" SOURCE_DATE_EPOCH="$epoch" \
  NODE_EXTRA_CA_CERTS=/build/certificates.crt \
  unshare --mount --pid --fork bash -c '
    mount --make-rprivate / && mount -t proc proc "$1/proc" && mount --bind /dev "$1/dev" &&
    { [ -z "$3" ] || mount --bind "$3" "$1/build/ccache"; } &&
    cp /etc/resolv.conf "$1/etc/resolv.conf" && exec chroot "$1" /build/myotact/tools/package.sh "$2"' \
  - "$root" "$preset" "${CCACHE:-}" >&2
cp "$root/build/myotact/build/$preset"/packages/*.deb "$target"
(cd "$target" && sha256sum ./*.deb)
