#!/bin/bash
# Draws the hard cases with all techniques and writes docs/results/hard_cases.{md,svg,csv}.
# Usage: tests/lab/pages/hard_cases.sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../../.."
source tests/lab/pages/common.sh
prepare gnomon_hard_cases

build/lab/bin/gnomon_hard_cases --known tests/lab/hard/red_cells.tsv -o docs/results
