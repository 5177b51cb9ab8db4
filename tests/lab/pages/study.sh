#!/bin/bash
# Measures what accuracy costs (`gnomon study`) and writes docs/guide/cost-of-accuracy.md from it,
# with docs/results/study.csv: ten scenes, seen by their own cameras, 512 x 512 pixels, maps of 1024
# texels, area lights by 16 and 64 samples. It goes on where it was interrupted, unless the program
# is another one. Last it replays the publications' conclusions (tests/lab/pages/conclusions.sh).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../../.."
source tests/lab/pages/common.sh
prepare

program=$(cat build/lab/bin/gnomon build/lab/lib/libGnomon*.so | cksum)
if [ "$(cat out/study/program.txt 2> /dev/null)" != "$program" ]; then
  rm -rf out/study
  mkdir -p out/study
  echo "$program" > out/study/program.txt
fi
build/lab/bin/gnomon study -o out/study --views 1 --size 512x512 --map-sizes 1024 \
  --frames 7 --truth-samples 1024
mkdir -p docs/results
tr -d '\r' < out/study/study.csv > docs/results/study.csv
python3 tests/lab/pages/study_page.py docs/results/study.csv "$(machine)" > docs/guide/cost-of-accuracy.md
tests/lab/pages/conclusions.sh
