#!/bin/bash
# Measures the figures of README.md and puts them there, with the pictures in docs/figures: the bunny
# scene, 1024 x 1024 pixels, maps of 1024 x 1024 texels.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source cmake/debian.sh
source docs/comparisons.sh

install_packages
build release
build/release/bin/gnomon compare bunny -o out/figures --frames 31

mkdir -p docs/figures
for variant in plain-VTK vtkShadowMapPass-1024 nsm-1024-inline raytraced; do
  cp "out/figures/$variant.png" docs/figures/
done
cp out/figures/chart.png docs/figures/

# The columns by their names, so that new ones do not shift the table.
table=$(results out/figures | awk -F, '
  NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
  function value(name) { return $(column[name]) }
  NR == 2 {
    for (i = 1; i <= split("static camera_moving light_moving", modes, " "); ++i)
      plain[modes[i]] = value(modes[i] "_ms")
    print "| | wrong pixels | false light | false shadow | neither lit nor dark | static | camera moving | light moving |"
    print "|---|---|---|---|---|---|---|---|"
  }
  {
    facing = value("facing_pixels")
    printf "| %s | %.3f %% | %.3f %% | %.3f %% | %.2f %% |", value("variant"),
      100 * value("wrong_share"), 100 * value("false_light_pixels") / facing,
      100 * value("false_shadow_pixels") / facing, 100 * value("between_share")
    for (i = 1; i <= 3; ++i)
      printf " %.1f ms (%.2f) |", value(modes[i] "_ms"), value(modes[i] "_ms") / plain[modes[i]]
    printf "\n"
  }')

awk -v table="$table" -v machine="$(machine)" '
  /<!-- figures -->/ { print; print ""; print table; print ""; print "Measured on: " machine "."; print ""; skip = 1; next }
  /<!-- end of figures -->/ { skip = 0 }
  !skip { print }' README.md > out/README.md
mv out/README.md README.md
