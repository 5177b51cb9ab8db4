#!/bin/bash
# Sweeps the hybrid techniques over maps, pictures and views, as the theses that they come from did on their own
# scenes, and writes docs/sweeps.md, of which docs/sweeps_page.py makes the text and tables. What the same program has
# measured in the same way before, in out/sweeps, is not measured again.
# Usage: docs/sweeps.sh [counts]
# With `counts` nothing is timed, for which alone a machine needs to be quiet; the page, without times, is out/sweeps/page.md.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source docs/comparisons.sh
prepare python3-pandas

views=(bench-with bench-side bench-against trees-with trees-side trees-against
  flowers-with flowers-side flowers-against atrium)
fan=crsma:adjacency_ring=vertices
hybrids="coherence,crsm:as_published=on,crsm,crsma:as_published=on,crsma,$fan,silhouette,silhouette:fit=once,selective"
out=out/sweeps
mkdir -p "$out"

frames=0
runs=() # those that the page is written from
# compare NAME SCENE OPTION... : into $out/NAME; without times where nobody asks for them, and then next to others
compare() {
  runs+=("$1")
  if [ "$frames" -gt 0 ]; then
    compareOnce "$out/$1" "$2" --frames "$frames" --route image "${@:3}"
    return
  fi
  while [ "$(jobs -rp | wc -l)" -ge "$(nproc)" ]; do
    wait -n
  done
  compareOnce "$out/$1" "$2" --frames 0 --route image "${@:3}" &
}

# bakeAlways TECHNIQUE,... : `crsm` and its kin so that they draw their maps in every frame in which the light moves,
# without which they trace all till it rests
bakeAlways() {
  local technique list=
  for technique in ${1//,/ }; do
    case "$technique" in crsm*|silhouette*) technique+=":bake=always" ;; esac
    list+="${list:+,}$technique"
  done
  echo "$list"
}

# What is timed comes first: a machine that is quiet needs to be so for that long only.
timedViews=(bench-side atrium)
timedCells=(1024x1024.512 1024x1024.1024 1024x1024.2048 1024x1024.4096 512x512.1024 1920x1080.1024)
cellFrames=5
viewFrames=7
if [ "${1:-}" != counts ]; then
  timed="$(bakeAlways "nsm,${hybrids/$fan,/}")"
  for view in "${timedViews[@]}"; do
    for cell in "${timedCells[@]}"; do
      frames="$cellFrames" compare "$view.timed-$cell" "$view" --techniques "$timed" --map-sizes "${cell#*.}" --size "${cell%.*}"
    done
  done
  timed="$(bakeAlways "nsm,$hybrids")"
  for view in "${views[@]}"; do
    frames="$viewFrames" compare "$view.timed.1024" "$view" --techniques "$timed" --map-sizes 1024
  done
fi

for cell in 1920x1080.1024 1024x1024.{4096,2048,1024,512} 512x512.1024; do
  for view in "${views[@]}"; do
    compare "$view.$cell" "$view" --techniques "nsm,$hybrids" --map-sizes "${cell#*.}" --size "${cell%.*}"
  done
done

# The 72 cases of the selective chain: twelve views, two maps, three widths of the contour. Of each the whole chain; hints
# of nine texels; without hints, where only what is outside of the contour is wrong; what is left lit; and its stages by
# themselves, the rest lit.
chainViews=("${views[@]:0:9}" primitives-with primitives primitives-against)
chains=nsm,coherence
for width in 2 4 6; do
  chain="selective:contour=$width"
  chains+=",$chain,$chain:coherence=9,$chain:coherence=off,$chain:leftovers=lit"
  for stage in neighbours={1,4,9}:adjacency=off neighbours=off:adjacency={edges,vertices}; do
    chains+=",$chain:coherence=off:$stage:leftovers=lit"
  done
done
for map in 2048 1024; do
  for view in "${chainViews[@]}"; do
    compare "$view.chain.$map" "$view" --techniques "$chains" --map-sizes "$map"
  done
done

# The chain on maps that are fitted to what the camera sees, as the thesis' are.
fitted=nsm:fit=once
for width in 2 4 6; do
  fitted+=",selective:fit=once:contour=$width,selective:fit=once:contour=$width:coherence=off"
done
for map in 2048 1024; do
  for view in "${chainViews[@]}"; do
    compare "$view.fitted.$map" "$view" --techniques "$fitted" --map-sizes "$map"
  done
done

for job in $(jobs -p); do
  wait "$job"
done
docs/sweeps_page.py --machine "$(machine)" --view-frames "$viewFrames" --cell-frames "$cellFrames" \
  "$out" "${runs[@]}" > "$out/page.md"
if [ "${1:-}" != counts ]; then
  mv "$out/page.md" docs/sweeps.md
fi
