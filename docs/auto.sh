#!/bin/bash
# Measures how well `auto` chooses while the camera moves, and writes docs/results/auto.csv and
# docs/results/auto.md: twelve random places in each of 17 scenes, 512 x 512 pixels. PLACES and
# SCENES ask for others.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source docs/comparisons.sh
prepare

scenes="${SCENES:-bunny horse cat posts plates panels screens pole stack long-cube letter cups \
office terrain props trees-side atrium}"
cmake --preset release -DGNOMON_BUILD_TESTS=ON > build/configure.log
cmake --build --preset release --target gnomon_benchmark_auto
# shellcheck disable=SC2086
build/release/bin/gnomon_benchmark_auto $scenes --places "${PLACES:-12}" > out/auto.csv
cp out/auto.csv docs/results/auto.csv
python3 docs/auto_page.py docs/results/auto.csv "$(machine)" > docs/results/auto.md
