#!/bin/bash
# Runs ten of VTK's own programs by `auto`, moves their cameras, and writes
# docs/results/vtk_motion.md.
#
#   tests/lab/pages/vtk_motion.sh FOLDER DATA
#
# FOLDER and DATA are those of tests/lab/pages/vtk_programs.sh. Pictures are in out/vtk_motion.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../../.."
source tests/lab/pages/common.sh

takePrograms "$@"
out="$PWD/out/vtk_motion"
mkdir -p "$out"

# runOnce NAME TECHNIQUE FRAMES : pictures, light and times, as $out/NAME.TECHNIQUE.*
runOnce() {
  local prefix="$out/$1.$2"
  rm -f "$prefix".*
  (cd "$out" && env -u DISPLAY PROGRAM_OUT="$prefix" PROGRAM_TECHNIQUE="$2" PROGRAM_FRAMES="$3" \
    timeout 120 "$programs/$1" -I -D "$data" -T "$out") > "$prefix.log" 2>&1 || true
}

# isTheSame NAME : whether all windows show by `auto` at rest what rays show
isTheSame() {
  local picture
  for picture in "$out/$1".auto.*.ppm; do
    cmp -s "$picture" "${picture/.auto./.raytraced.}" || return 1
  done
}

rows=""
for name in Mace FrustumClip TestManyActors TestGlyph3DMapperEdges TestVDWSpheres \
  TestCompositePolyDataMapper2MixedGeometryEdges TestBlockVisibility \
  TestGlyph3DMapperQuaternionArray TestVBOPLYMapper TestShadowMapPass; do
  runOnce "$name" raytraced ""
  runOnce "$name" nsm 20
  runOnce "$name" auto 20
  light="$(cat "$out/$name.auto.lights")"
  rest="$(isTheSame "$name" && echo yes || echo no)"
  nsm="$(awk '{ printf "%.2f", $2 / $1 }' "$out/$name.nsm.motion")"
  IFS=$'\t' read -r plain auto choice < "$out/$name.auto.motion"
  ratio="$(awk -v a="$auto" -v b="$plain" 'BEGIN { printf "%.2f", a / b }')"
  plain="$(printf '%.1f' "$plain")"
  rows+="| $name | $light | $rest | $plain ms | $nsm | $ratio | ${choice#the picture moves: } |"$'\n'
done

triangles="$(sed -n 's/^element face //p;/^end_header/q' "$data/Data/dragon.ply" | tr -d '\r')"
cat > docs/results/vtk_motion.md << PAGE
# VTK's own programs in motion

Ten of [the programs](vtk_programs.md) by \`auto\`. At rest: whether each picture is that of
\`raytraced\`, byte for byte. In motion: the camera turns around a resting light; a frame's median as
a multiple of plain VTK's. The last two programs read \`dragon.ply\`, here of $triangles triangles.
\`tests/lab/pages/vtk_motion.sh\` measures this.

| program | light | exact at rest | plain VTK | \`nsm\` | \`auto\` | what \`auto\` takes |
|---|---|---|---|---|---|---|
${rows}
Measured on: $(machine).
PAGE
