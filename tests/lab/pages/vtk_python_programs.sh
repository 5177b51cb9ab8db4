#!/bin/bash
# Adds two lines to ten of VTK's own programs in Python, runs them without a display, compares
# pictures, and writes docs/results/vtk_python_programs.md.
#
#   tests/lab/pages/vtk_python_programs.sh VTK
#
# VTK is a checkout of VTK's source, v9.1.0. Python finds `gnomon` by PYTHONPATH, or in
# build/lab. Pictures are in out/vtk_python_programs.
set -euo pipefail
if [ $# -ne 1 ]; then
  echo "usage: docs/$(basename "$0") VTK" >&2
  exit 1
fi
vtk="$(cd "$1" && pwd)"
cd "$(dirname "${BASH_SOURCE[0]}")/../../.."
source tests/lab/pages/common.sh

export PYTHONPATH="${PYTHONPATH:-$PWD/build/lab/lib/python3/dist-packages}"
/usr/bin/python3 -c "import gnomon, numpy"
out="$PWD/out/vtk_python_programs"
rm -rf "$out"
mkdir -p "$out"

rows="" all=0 exact=0
for program in Common/DataModel/PerlinNoise Common/DataModel/scalarConn \
  Filters/Core/constrainedDelaunay Filters/Extraction/ExtractTensors Filters/General/clipHex \
  Filters/General/TestDiscreteMarchingCubes Filters/Modeling/KlineBottle \
  Filters/Modeling/schwarz Filters/Modeling/subDivideTetra Filters/Modeling/TenEllip; do
  name="$(basename "$program")"
  env -u DISPLAY timeout 120 tests/lab/vtk_programs/main.py \
    "$vtk/$(dirname "$program")/Testing/Python/$name.py" "$out/$name" > "$out/$name.log" 2>&1 ||
    echo "$name failed: $out/$name.log" >&2
  IFS=$'\t' read -r light shadow lit other messages < "$out/$name.result" ||
    light="**failed**" shadow="" lit="" other="" messages=""
  all=$((all + 1))
  [ "$shadow" = 0 ] || [ "$lit:$other" != 0:0 ] || exact=$((exact + 1))
  rows+="| $name | $light | $shadow | $lit | $other | $messages |"$'\n'
done

cat > docs/results/vtk_python_programs.md << PAGE
# VTK's own programs in Python

Of $all tests of VTK 9.1.0, $exact show exact shadows, and nothing else changes, with two lines more
and no setting:

    import gnomon                   # before the first import
    gnomon.add_shadows(renderer)    # before the first statement that draws

Columns: the light, where *key* is the light that \`add_shadows\` puts in place of VTK's headlight;
pixels that differ from plain VTK's under the same light by more than 8/255; pixels that differ at
all although all light reaches them; pixels whose visibility or colour at rest is not that of
\`raytraced\`, bit for bit; messages.

| program | light | in shadow | lit and changed | not as \`raytraced\` | messages |
|---|---|---|---|---|---|
${rows}
Run on: $(machine).

The programs have one renderer, no data files, and show a surface in the way of another's light.
\`tests/lab/vtk_programs/main.py\` adds the lines and runs a program: a window without a display stands
in for VTK's, without interaction. \`tests/lab/pages/vtk_python_programs.sh\` compares and writes this page.
PAGE
