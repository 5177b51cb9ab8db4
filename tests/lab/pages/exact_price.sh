#!/bin/bash
# Measures what exact hard shadows cost over plain VTK and writes docs/results/exact_price.md: four
# scenes under one sun each, 1024 x 1024 pixels, maps of 1024 x 1024 texels. What the same program
# has measured in the same way before, in out/exact_price, is not measured again.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../../.."
source tests/lab/pages/common.sh
prepare

scenes=(bunny terrain atrium city)
for scene in "${scenes[@]}"; do
  compareOnce "out/exact_price/$scene" "$scene" --techniques nsm,silhouette,raytraced \
    --route inline --frames 15
done
python3 tests/lab/pages/exact_price_page.py out/exact_price "$(machine)" "${scenes[@]}" \
  > docs/results/exact_price.md
