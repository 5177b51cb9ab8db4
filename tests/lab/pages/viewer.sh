#!/bin/bash
# Draws docs/figures/viewer.png by keys pressed in the viewer, on an X server without a screen, and
# puts the table of keys into docs/guide/viewer.md.
#
#   tests/lab/pages/viewer.sh [GNOMON]    by default build/lab/bin/gnomon
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../../.."
gnomon="${1:-build/lab/bin/gnomon}"

folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
xvfb-run -a "$gnomon" view bunny --size 720x480 --techniques nsm --map-size 256 --press "  gq" \
  -o "$folder/viewer"
mv "$folder/viewer-1.png" docs/figures/viewer.png

page=docs/guide/viewer.md
{
  sed '/^| key /,$d' "$page"
  "$gnomon" view --keys
} > "$folder/page"
mv "$folder/page" "$page"
