#!/usr/bin/env bash
# Builds and runs the comparison with other programs: run.sh [OUT], tables to OUT/peers.md (build/peers/peers.md).
# MYOTACT_CANINE_DIR: the canine data, for the muscles. Installs what packages.txt names and MuJoCo's npm package.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../../.."
source tools/common.sh

mujoco_version=3.14.0
out="${1:-build/peers}"
mkdir -p "$out"
install_missing tools/packages.txt tests/bench/peers/packages.txt
if ! command -v npm >/dev/null; then install_missing tools/packages-web.txt; fi
build bundled -DMYOTACT_PEERS=ON -- peers_steps peers_touch
if [ ! -d "$out/node_modules/@mujoco/mujoco" ]; then
  npm install --prefix "$out" --no-fund --no-audit "@mujoco/mujoco@$mujoco_version" >&2
fi

export OPENBLAS_NUM_THREADS=1  # a BLAS with threads of its own gives CHOLMOD one, too
programs=build/bundled/tests/bench/peers
{
  echo "$(date -u +%F), $(sed -n 's/^model name\s*: //p' /proc/cpuinfo | head -1), $(nproc) hardware threads, load $(cut -d' ' -f1 /proc/loadavg)"
  echo
  "$programs/peers_steps" "$out"
  printf '\n## MuJoCo: rows of the first table\n\n'
  echo '| body | program | law | threads | ms a step, median | 90th | error to the converged answer, % | tip y, mm | tip to quadratic, % |'
  echo '|---|---|---|---|---|---|---|---|---|'
  bodies=(beam_2k)
  if [ -n "${MYOTACT_CANINE_DIR:-}" ]; then bodies+=(bic_2k); fi
  node tests/bench/peers/mujoco_flex.mjs "$out" "$out" "${bodies[@]}"
  echo
  "$programs/peers_touch"
} | tee "$out/peers.md"
