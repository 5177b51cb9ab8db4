#!/bin/bash
# Draws the pictures of docs/guide/examples.md by the programs of examples/.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../../.."
source tests/lab/pages/common.sh
prepare all

figures=docs/figures/examples
mkdir -p $figures
for example in assembly atrium ct_area_light shader_waves; do
  env -u DISPLAY build/lab/bin/$example $figures/$example.png 640 480
done
env -u DISPLAY build/lab/bin/molecule $figures/molecule.png 600 450 # at most 150 KB each
figure=$(mktemp -d)/headless_figure.png # the EXR that goes with it does not stay
env -u DISPLAY build/lab/bin/headless_figure "$figure" 640 480
mv "$figure" $figures/
export PYTHONPATH=$PWD/build/lab/lib/python3/dist-packages
for example in molecule_surface streamtubes technique_table; do
  env -u DISPLAY /usr/bin/python3 examples/$example.py $figures/$example.png 640 480
done
env -u DISPLAY /usr/bin/python3 examples/terrain_sun_hours.py $figures/terrain_sun_hours.png 500 375
env -u DISPLAY /usr/bin/python3 examples/moving_light.py $figures/moving_light.png 640 480 1
env -u DISPLAY GNOMON_REFRESH_BASELINES=1 /usr/bin/python3 examples/image_test.py
xvfb-run -a build/lab/bin/qt_shadows $figures/qt_shadows.png
