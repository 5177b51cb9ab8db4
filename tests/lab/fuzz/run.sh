#!/bin/bash
# Fuzzes the reader of scene files. Needs clang and libclang-rt-dev.
#
#   tests/lab/fuzz/run.sh [SECONDS]
#
# Its finds are written to build/fuzz/ as crash-..., slow-unit-... or oom-...
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../../.."
seconds=${1:-180}
build=build/fuzz

cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo \
  -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ \
  -DCMAKE_CXX_FLAGS="-fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=undefined" \
  -DGNOMON_BUILD_LAB=ON -DGNOMON_BUILD_FUZZERS=ON
ninja -C "$build" gnomon_fuzz_scene_file

# The seeds: the scenes of the tests, with their models beside the fuzzed file.
mkdir -p "$build/folder" "$build/corpus"
cp -r tests/check/scenes/. "$build/folder/"
cp tests/check/scenes/*.json "$build/corpus/"
cd "$build"
GNOMON_FUZZ_FOLDER=$PWD/folder ASAN_OPTIONS=detect_leaks=0 bin/gnomon_fuzz_scene_file corpus \
  -max_total_time="$seconds" -timeout=10 -rss_limit_mb=4096 -max_len=8192
