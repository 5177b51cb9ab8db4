#!/bin/bash
# Draw pictures of pages into docs/figures.
#
#   tests/lab/pages/draw.sh gallery      scenes by `auto`
#   tests/lab/pages/draw.sh techniques   how pixels are decided, and what goes wrong
#   tests/lab/pages/draw.sh examples     by the programs of examples/
#   tests/lab/pages/draw.sh viewer       the viewer, and the table of its keys in viewer.md
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../../.."
source cmake/debian.sh
programs=build/lab/bin
figures=docs/figures

# drawPair PICTURE COMMAND... : what the command draws into {picture}, beside plain VTK's
drawPair()
{
  local command=("${@:2}") plain=$PWD/build/lab/lib/libgnomon_plain_vtk.so
  # A program may fail after its picture: plain VTK has no visibility to export.
  LD_PRELOAD=$plain "${command[@]/'{picture}'/out/plain.png}" || true
  "${command[@]/'{picture}'/out/gnomon.png}"
  /usr/bin/python3 tests/lab/pages/side_by_side.py "$1" "plain VTK=out/plain.png" \
    "Gnomon=out/gnomon.png"
}

gallery()
{
  local scene sky distance
  while read -r scene sky distance; do
    drawPair "$figures/$scene.png" $programs/gnomon render "$scene" -o '{picture}' \
      --size 320x240 --sky "$sky" --sky-distance "$distance"
  done << END
terrain 0.4 0
atrium 0.5 100
bench-side 0.3 0
cups 0.4 0
office 0.3 0.5
soft-window 0.3 0
END
  $programs/gnomon render bunny -o $figures/no_sky.png --size 400x300
  $programs/gnomon render bunny -o $figures/sky.png --size 400x300 --sky 0.5
  $programs/gnomon render props -o $figures/props.png --size 900x560 --camera "fov=32" --sky 0.3 \
    --glass
}

techniques()
{
  # render SCENE PICTURE OPTION...
  render() {
    $programs/gnomon render "$1" --size 480x480 -o "$2" "${@:3}"
  }
  render bunny out/picture.png --technique silhouette --classes $figures/exact.png
  render bunny out/picture.png --technique selective --classes $figures/selective.png
  render soft-stack out/picture.png --technique penumbra --classes $figures/penumbra_classes.png
  render cups $figures/published.png --technique crsm --as-published on
  render soft-stack $figures/sampled.png --technique sampled --light-samples 16
}

examples()
{
  local example out=$figures/examples
  mkdir -p $out
  export PYTHONPATH=$PWD/build/lab/lib/python3/dist-packages
  for example in assembly atrium headless_figure molecule shader_waves; do
    drawPair $out/$example.png $programs/$example '{picture}' 320 240
  done
  for example in molecule_surface nested_surfaces shadow_catcher streamtubes terrain_sun_hours; do
    drawPair $out/$example.png /usr/bin/python3 examples/$example.py '{picture}' 320 240
  done
  drawPair $out/moving_light.png /usr/bin/python3 examples/moving_light.py '{picture}' 320 240 1
  for scene in scan smoke case; do
    drawPair $out/volume_$scene.png /usr/bin/python3 examples/volume_shadows.py \
      '{picture}' 320 240 $scene
  done
  $programs/ct_area_light $out/ct_area_light.png 640 320 # without and with shadows
  /usr/bin/python3 examples/technique_table.py $out/technique_table.png 640 480
  GNOMON_REFRESH_BASELINES=1 /usr/bin/python3 examples/image_test.py
  xvfb-run -a $programs/qt_shadows $out/qt_shadows.png
}

viewer()
{
  local page=docs/guide/viewer.md
  xvfb-run -a $programs/gnomon view bunny --size 720x480 --techniques nsm --map-size 256 \
    --press "  gq" -o out/viewer
  mv out/viewer-1.png $figures/viewer.png
  {
    sed '/^| key /,$d' "$page"
    $programs/gnomon view --keys
  } > out/viewer.md
  mv out/viewer.md "$page"
}

if [ $# -ne 1 ] || ! grep -q "draw.sh $1 " "${BASH_SOURCE[0]}"; then
  sed -n '2,/^set/{s/^# \{0,1\}//;/^set/d;p}' "${BASH_SOURCE[0]}" >&2
  exit 1
fi
install_packages libvtk9-qt-dev
mkdir -p build out
cmake --preset lab > build/configure.log
cmake --build --preset lab
unset DISPLAY
"$1"
