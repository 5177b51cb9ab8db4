#!/bin/bash
# Replays the conclusions of the publications that the techniques come from, and writes
# docs/results/conclusions.md and .csv, of which tests/lab/pages/conclusions_page.py makes rows and verdicts.
# It takes a quarter of an hour. What the same program has measured in the same way before, in
# out/conclusions, is not measured again.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../../.."
source tests/lab/pages/common.sh
prepare gnomon_benchmark_fitting gnomon_test_lights

out=out/conclusions
mkdir -p "$out"

# run NAME TECHNIQUES SCENES OPTION... : `gnomon compare` of each scene into $out/NAME.SCENE
run() {
  local scene
  for scene in $3; do
    compareOnce "$out/$1.$scene" "$scene" --techniques "$2" "${@:4}"
  done
}

views="bench-with trees-side flowers-against atrium"
counts=(--map-sizes "1024,2048" --route image --frames 0)
published=crsm:as_published=on,crsma:as_published=on
run hybrid "nsm,coherence,crsm,crsma,$published" "$views" "${counts[@]}"

run times "coherence,$published" "$views" --route image --frames 7

# Moderno fits maps to what the camera sees.
chain=selective:fit=once
chains="nsm:fit=once,$chain,$chain:coherence=off,$chain:leftovers=lit"
for stage in neighbours={1,4,9}:adjacency=off neighbours=off:adjacency={edges,vertices}; do
  chains+=",$chain:coherence=off:$stage:leftovers=lit"
done
run chain "$chains" "$views" "${counts[@]}"

box=pcf:kernel=box:kernel_size
disc=adaptive:early_out=ring:kernel_size
filters="nsm,nsm:depth=second,pcf:kernel_size=1,$box=3,$box=4,$box=11"
filters+=",pcf:kernel=poisson:kernel_size=4,$disc=3:disc_grid=3,$disc=11:disc_grid=11"
run filters "$filters,vsm:kernel_size=23" "bunny posts plates terrain" --route inline --frames 5

run metric "$box=11,$box=11:metric=euclidean" "room office" --route image --frames 0

soft="$box=11,$disc=11:disc_grid=11,vsm:kernel_size=23,pcss,pcss:pcss_samples=high"
soft+=,sampled:light_samples=512
for batch in 1 2 4 8; do
  soft+=",sampled:batch=$batch"
done
run soft "$soft" "soft-stack soft-panels soft-plates soft-long-cube" --route image \
  --size 256x256 --frames 5 --truth-samples 1024

# Curtis' dragon is the bunny here.
montecarlo=montecarlo:mc_layers=near:mc_pyramid=nbuffer,montecarlo
for way in layers=near_far:mc_pyramid=nbuffer layers=eye:mc_search=linear; do
  montecarlo+=",montecarlo:mc_rays=2:mc_$way,montecarlo:mc_$way"
done
curtis=(--map-sizes "512,1024" --size 384x288 --frames 7 --truth-samples 256)
run montecarlo "$montecarlo" bunny "${curtis[@]}" --light-radius 5
run montecarlo "$montecarlo" soft-long-cube "${curtis[@]}"

build/lab/bin/gnomon_benchmark_fitting 2048 21 > "$out/fitting.txt"
build/lab/bin/gnomon_test_lights --gtest_filter='ReducedMd5.*' > "$out/md5.txt" ||
  true # the page tells

python3 tests/lab/pages/conclusions_page.py "$out" docs/results/conclusions.csv "$(machine)" \
  > docs/results/conclusions.md
