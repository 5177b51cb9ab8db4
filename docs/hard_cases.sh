#!/bin/bash
# Draws the hard cases with all techniques and writes docs/results/hard_cases.{md,svg,csv}.
# Usage: docs/hard_cases.sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source docs/comparisons.sh
prepare
buildTests gnomon_hard_cases

build/release/bin/gnomon_hard_cases --known tests/hard/red_cells.tsv -o docs/results
