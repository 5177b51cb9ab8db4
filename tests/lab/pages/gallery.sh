#!/bin/bash
# Renders the pictures of docs/guide/examples.md and docs/guide/what_casts.md by `auto`, in a minute.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../../.."
source tests/lab/pages/common.sh
prepare

# picture SCENE SIZE OPTION... : docs/figures/SCENE.png
picture() {
  env -u DISPLAY build/lab/bin/gnomon render "$1" -o "docs/figures/$1.png" --size "$2" "${@:3}"
}
for scene in terrain atrium bench-side office soft-window cups; do
  picture "$scene" 400x300
done
picture props 900x560 --camera "fov=32"
