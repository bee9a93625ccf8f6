# Sourced by the scripts of this folder: where the project is, and its packages.

project="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"

# install_missing FILE...: installs the packages of the lists that are not there. Ends with 69 when it may not.
install_missing() {
  local missing=() package
  while read -r package; do
    if ! dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q '^install ok installed'; then
      missing+=("$package")
    fi
  done < <(sed '/^#/d;/^$/d' "$@")
  if [ ${#missing[@]} -eq 0 ]; then return; fi
  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    if ! sudo -n true 2>/dev/null && ! { [ -t 0 ] && sudo true; }; then
      echo "packages are missing and this user may not install them. Run once, then start again:" >&2
      echo "  sudo apt-get install -y ${missing[*]}" >&2
      exit 69
    fi
    as_root=(sudo)
  fi
  echo "installing: ${missing[*]}" >&2
  if ! "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "${missing[@]}" >&2; then
    "${as_root[@]}" apt-get update >&2
    if ! "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "${missing[@]}" >&2; then
      echo "the packages could not be installed. Run: sudo apt-get install -y ${missing[*]}" >&2
      exit 69
    fi
  fi
}

# phase NAME COMMAND...: runs it and prints how long it took.
phase() {
  local name="$1" start=$SECONDS
  shift
  "$@"
  printf -- '-- %s: %d min %02d s\n' "$name" $(((SECONDS - start) / 60)) $(((SECONDS - start) % 60)) >&2
}

# build PRESET [cmake options...] [-- targets...]: configures when needed and builds.
build() {
  local preset="$1" options=() targets=()
  shift
  while [ $# -gt 0 ] && [ "$1" != "--" ]; do options+=("$1"); shift; done
  if [ $# -gt 0 ]; then shift; targets=(--target "$@"); fi
  if command -v ccache >/dev/null; then
    export CMAKE_CXX_COMPILER_LAUNCHER=ccache
    export CCACHE_SLOPPINESS="${CCACHE_SLOPPINESS:-pch_defines,time_macros}"  # or it leaves precompiled headers alone
    export CCACHE_BASEDIR="$project" CCACHE_NOHASHDIR=1  # checkouts in several places share what they compile alike
    export CCACHE_DEPEND="${CCACHE_DEPEND:-1}"  # else what is not in the cache is preprocessed once more
  fi
  if [ ! -f "$project/build/$preset/build.ninja" ] || [ ${#options[@]} -gt 0 ]; then
    (cd "$project" && cmake --preset "$preset" "${options[@]}" >&2)
  fi
  (cd "$project" && cmake --build --preset "$preset" "${targets[@]}" >&2)
}

# Of tests that are slow under a sanitizer, or whose timing means nothing there: these run in release only.
release_only='slow|realtime|validation'

# run_tests PRESET [ctest options...]: two at a time.
run_tests() {
  local preset="$1"
  shift
  ctest --test-dir "$project/build/$preset" -j2 --output-on-failure "$@"
}
