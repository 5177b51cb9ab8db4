#!/bin/bash
# Measures how well `auto` chooses while the camera moves, and writes docs/results/auto.md,
# docs/results/auto.csv and docs/results/auto_flights.csv: 200 random places in each of 31 scenes,
# 512 x 512 pixels; at COMPARED of them `auto` is timed beside single techniques. The table has a
# line for each of these, and for each place where the error was not kept. PLACES and SCENES ask
# for others. Flights have a time budget, and an error or none.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../../.."
source tests/lab/pages/common.sh
prepare gnomon_benchmark_auto

scenes="${SCENES:-bunny horse cat posts plates panels screens pole stack long-cube letter cups \
office terrain props trees-side atrium cube half-plane room molecule primitives bench-side \
flowers-side building-lit building soft-stack soft-panels soft-plates soft-long-cube soft-window}"
# shellcheck disable=SC2086
build/lab/bin/gnomon_benchmark_auto $scenes --places "${PLACES:-200}" \
  --compared "${COMPARED:-12}" > out/auto.csv
awk -F, 'NR == 1 || $8 != "" || !($7 <= $6)' out/auto.csv > docs/results/auto.csv
flights build/lab/bin/gnomon_benchmark_auto > docs/results/auto_flights.csv
python3 tests/lab/pages/auto_page.py out/auto.csv docs/results/auto_flights.csv \
  "$(machine)" > docs/results/auto.md
