#!/bin/bash
# Renders pictures of docs/techniques into docs/figures: how pixels were decided (--classes), or what
# goes wrong.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../../.."
source tests/lab/pages/common.sh
prepare

# render SCENE PICTURE OPTION...
render() {
  build/lab/bin/gnomon render "$1" --size 480x480 -o "$2" "${@:3}"
}
mkdir -p out/figures docs/figures
render bunny out/figures/picture.png --technique silhouette --classes docs/figures/exact.png
render bunny out/figures/picture.png --technique selective --classes docs/figures/selective.png
render soft-stack out/figures/picture.png --technique penumbra \
  --classes docs/figures/penumbra_classes.png
render cups docs/figures/published.png --technique crsm --as-published on
render soft-stack docs/figures/sampled.png --technique sampled --light-samples 16
