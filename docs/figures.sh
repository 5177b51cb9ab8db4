#!/bin/bash
# Measures the figures of README.md and puts them there, with the pictures in docs/figures: the bunny
# scene, 1024 x 1024 pixels, maps of 1024 x 1024 texels, under its sun as a point and as a disk of 5 degrees.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source cmake/debian.sh
source docs/comparisons.sh

install_packages
build release

hard=nsm,pcf,vsm,evsm,msm,adaptive,lispsm,tsm,pssm,planar,coherence,selective,crsm,crsma,silhouette,raytraced
soft=pcss,montecarlo,sampled,penumbra,raytraced
compareOnce out/figures/hard bunny --techniques "$hard" --route inline --frames 31
compareOnce out/figures/soft bunny --techniques "$soft" --route inline --frames 11 --light-radius 5

mkdir -p docs/figures
# copy FOLDER VARIANT NAME : one of the pictures
copy() {
  cp "out/figures/$1/$2.png" "docs/figures/$3.png"
}
copy hard plain-VTK plain-VTK
copy hard vtkShadowMapPass-1024 vtkShadowMapPass-1024
copy hard nsm-1024-inline nsm-1024-inline
copy hard raytraced raytraced
copy hard chart chart
copy soft pcss-1024-inline pcss
copy soft montecarlo-1024 montecarlo
copy soft penumbra penumbra

# table FOLDER HEADS CELLS : the variants' errors, by awk's CELLS, under HEADS, and their times. Columns go by their names, so that new
# ones do not shift the table.
table() {
  results "out/figures/$1" | awk -F, -v heads="$2" "
    NR == 1 {
      for (i = 1; i <= NF; ++i) column[\$i] = i
      next
    }
    function value(name) { return \$(column[name]) }
    function share(name) { return 100 * value(name) / value(\"facing_pixels\") }
    NR == 2 {
      for (i = 1; i <= split(\"static camera_moving light_moving\", modes, \" \"); ++i)
        plain[modes[i]] = value(modes[i] \"_ms\")
      print \"| |\" heads \" static | camera moving | light moving |\"
      gsub(/[^|]+/, \"---\", heads)
      print \"|---|\" heads \"---|---|---|\"
    }
    {
      printf \"| %s |\", value(\"variant\")
      printf $3
      for (i = 1; i <= 3; ++i)
        printf \" %.1f ms (%.2f) |\", value(modes[i] \"_ms\"), value(modes[i] \"_ms\") / plain[modes[i]]
      printf \"\\n\"
    }"
}

{
  table hard " wrong pixels | false light | false shadow | neither lit nor dark |" \
    '" %.3f %% | %.3f %% | %.3f %% | %.2f %% |", share("wrong_pixels"), share("false_light_pixels"), share("false_shadow_pixels"), share("between_pixels")'
  echo
  echo "Soft shadows under a sun of 5 degrees, 64 points of it (\`montecarlo\`: 9); the error of visibility against 4,096 points:"
  echo
  table soft " mean absolute error | root mean square |" '" %.4f | %.4f |", value("mean_absolute_error"), value("rms_error")'
  echo
  echo "Measured on: $(machine)."
} > out/figures/tables.md

awk '
  /<!-- figures -->/ {
    print
    print ""
    while ((getline line < "out/figures/tables.md") > 0) print line
    print ""
    skip = 1
    next
  }
  /<!-- end of figures -->/ { skip = 0 }
  !skip { print }' README.md > out/README.md
mv out/README.md README.md
