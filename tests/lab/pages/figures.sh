#!/bin/bash
# Measures the figures of README.md and docs/results/bunny.md and puts them there, with the pictures
# in docs/figures: the bunny scene, 1024 x 1024 pixels, maps of 1024 x 1024 texels, under its sun as
# a point and as a disk of 5 degrees. What the same program has measured in the same way before, in
# out/figures, is not measured again.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../../.."
source tests/lab/pages/common.sh
prepare

hard=nsm,pcf,esm,vsm,evsm,msm,adaptive,lispsm,tsm,pssm,planar,coherence,selective,crsm,crsma,silhouette,raytraced
soft=pcss,montecarlo,sampled,penumbra,raytraced
compareOnce out/figures/hard bunny --techniques "$hard" --route inline --frames 31
compareOnce out/figures/soft bunny --techniques "$soft" --route image --frames 11 --light-radius 5

mkdir -p docs/figures
# copy FOLDER VARIANT NAME : one of the pictures
copy() {
  cp "out/figures/$1/$2.png" "docs/figures/$3.png"
}
copy hard first first
copy hard plain-VTK plain-VTK
copy hard vtkShadowMapPass-1024 vtkShadowMapPass-1024
copy hard nsm-1024-inline nsm-1024-inline
copy hard raytraced raytraced
copy hard chart chart
copy soft pcss-1024-image pcss
copy soft montecarlo-1024 montecarlo
copy soft penumbra penumbra

python3 tests/lab/pages/bunny_page.py out/figures/hard out/figures/soft "$(machine)"
