#!/bin/bash
# Measures hard and soft shadows, a frame's costs and how `auto` chooses on a machine with a GPU,
# and writes docs/results/gpu.md. PROGRAMS is the folder of `gnomon` and `gnomon_benchmark_auto`;
# without it they are built.
#
#   tests/lab/pages/gpu.sh [PROGRAMS]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../../.."
source tests/lab/pages/common.sh
programs="${1:-}"
if [ -z "$programs" ]; then
  prepare gnomon_benchmark_auto
  programs=build/lab/bin
fi

hard=(bunny terrain atrium city)
places=(bunny horse cat posts plates panels screens pole stack long-cube letter cups office terrain
  props trees-side atrium)
rm -rf out/gpu
mkdir -p out/gpu
for scene in "${hard[@]}"; do
  "$programs/gnomon" compare "$scene" -o "out/gpu/$scene" --techniques nsm,silhouette,raytraced \
    --route inline --frames 15
done
"$programs/gnomon" compare bunny -o out/gpu/soft \
  --techniques pcss,montecarlo,sampled,penumbra,raytraced --route image --frames 11 --light-radius 5
"$programs/gnomon" calibrate -o out/gpu/factors.txt
"$programs/gnomon_benchmark_auto" "${places[@]}" --places 20 > out/gpu/auto.csv
flights "$programs/gnomon_benchmark_auto" > out/gpu/flights.csv
python3 tests/lab/pages/gpu_page.py out/gpu "${hard[@]}" > docs/results/gpu.md
