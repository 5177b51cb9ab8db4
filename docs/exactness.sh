#!/bin/bash
# Compares the exact techniques with ray tracing on the built-in scenes and on random pictures, and writes docs/exactness.md.
# Usage: docs/exactness.sh [RUNS]
# RUNS random pictures of each of 16 kinds of scenes, each with a camera and a light of its own. One light in six shines straight
# down: with 100, each technique sees 1,600 cameras and more than 1,000 lights that do not. And RUNS pictures of each of ten built-in scenes, from
# anywhere, in any light: with 100, 1,000 cameras and lights.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source cmake/debian.sh

runs="${1:-300}"
install_packages
build release

mkdir -p out
reports=(out/exactness_truth.json out/exactness_plugin.json)
rm -f "${reports[@]}"
# The page also says what is wrong, so that it is written in any case.
failed=0
# compareRandom TESTS FILTER : into their report
compareRandom() {
  env -u DISPLAY GNOMON_EXACT_RUNS="$runs" "build/release/bin/gnomon_test_$1" --gtest_filter="$2" \
    --gtest_output="json:out/exactness_$1.json" || failed=1
}
compareRandom truth '*ConservativeMapsIn.*:*ConservativeMapsOnGpu.*:*ConservativeMapsAnywhere.*:*ChainIn.*:Chain.isNeverWrong*:*RandomPenumbras.*'
compareRandom plugin '*ExactScenesFromAnywhere.*'
for report in "${reports[@]}"; do
  [ -e "$report" ]
done

# Built-in scenes.
pictures=out/exactness
rm -rf "$pictures"
mkdir -p "$pictures"

# visibility NAME SCENE OPTION... : draws into $pictures/NAME.exr and .json; these are not there where that fails
visibility() {
  local name="$pictures/$1"
  rm -f "$name.exr" "$name.json"
  build/release/bin/gnomon render "$2" -o "$name.png" --visibility "$name.exr" --stats "$name.json" "${@:3}" > /dev/null
}

# cell SCENE OPTION... : the share of pixels facing the light that the technique traced, or how it differs from raytraced, or
# that one of them could not be drawn
cell() {
  local status=0
  visibility exact "$@" || status=$?
  if [ "$status" = 0 ]; then
    build/release/bin/gnomon diff "$pictures/exact.exr" "$pictures/truth.exr" > "$pictures/differences.txt" || status=$?
    # Other failures end with 1, too, but say nothing of pixels.
    [ "$status" != 1 ] || [ ! -s "$pictures/differences.txt" ] || status=differ
  fi
  if [ "$status" = 0 ]; then
    awk '
      /"traced_pixels":/ { traced += $2 }
      /"classes": \{/ { inside = 1; next }
      /\}/ { inside = 0 }
      inside && !/"(turned away from the light|no receiver)":/ { sub(/.*: /, ""); facing += $0 }
      END { printf " %.1f |", (facing > 0 ? 100 * traced / facing : 0) }' "$pictures/exact.json"
    return
  fi
  failed=1
  if [ "$status" = differ ]; then
    printf ' **%s differ** |' "$(cut -d' ' -f1 "$pictures/differences.txt")"
  else
    printf ' **failed** |'
  fi
}

# row SCENE PICTURE [OPTION VALUE] : what each of the techniques makes of a scene
techniques=()
row() {
  local technique name="$1"
  [ "${3-}" != --map-size ] || name+=", map $4"
  [ "${3-}" != --light-radius ] || name+=", radius $4"
  visibility truth "$1" --technique raytraced --size "$2" "${@:3}" || true # then its cells fail
  printf '| %s |' "$name"
  for technique in "${techniques[@]}"; do
    # shellcheck disable=SC2086 # a technique with its options
    cell "$1" --technique $technique --size "$2" "${@:3}"
  done
  echo
}

scenes=$(build/release/bin/gnomon scenes | awk '{ print $1 }')
hard=$(grep -v '^soft-' <<< "$scenes" | grep -vx city)
{
  echo "| scene | \`crsm\` | \`crsma\` | fan | \`silhouette\` | \`silhouette\`, \`fit\` frame | \`selective\` |"
  echo "|---|---|---|---|---|---|---|"
  techniques=(crsm crsma "crsma --adjacency-ring vertices" silhouette "silhouette --fit frame" "selective --contour image --coherence off")
  for scene in $hard; do
    row "$scene" 1024x1024
  done
  for size in 64 256 4096; do
    for scene in bunny atrium bench-side room; do
      row "$scene" 512x512 --map-size "$size"
    done
  done
  row city 200x200 --map-size 512
} > "$pictures/hard.md"

# Rays by the GPU's tracer against Embree's: the same, but for those that pass an edge to within a rounding, one in a million at most.
allRays=0 allDiffering=0
{
  echo "| scene | rays | pixels that differ |"
  echo "|---|---|---|"
  for scene in $hard; do
    if visibility truth "$scene" --technique raytraced --size 1024x1024 &&
      visibility exact "$scene" --technique raytraced --size 1024x1024 --tracer gpu; then
      rays=$(awk '/"rays":/ { sum += $2 } END { print sum + 0 }' "$pictures/exact.json")
      differing=$(build/release/bin/gnomon diff "$pictures/exact.exr" "$pictures/truth.exr" | cut -d' ' -f1) || true
      allRays=$((allRays + rays)) allDiffering=$((allDiffering + differing))
      echo "| $scene | $rays | $differing |"
    else
      failed=1
      echo "| $scene | | **failed** |"
    fi
  done
  echo "| all | $allRays | $allDiffering |"
} > "$pictures/tracers.md"
[ "$allDiffering" -le $((allRays / 1000000)) ] || failed=1
{
  echo "| scene | \`penumbra\` |"
  echo "|---|---|"
  techniques=(penumbra)
  for scene in $(grep '^soft-' <<< "$scenes"); do
    row "$scene" 1024x1024
  done
  for scene in $hard; do
    row "$scene" 512x512 --light-radius 0.5
  done
  # Suns that are a tenth of the scene, about: what penumbra is timed with.
  for scene in bunny bench-side atrium; do
    row "$scene" 1024x1024 --light-radius 5
  done
} > "$pictures/soft.md"

# What tests recorded (tests/unit/truth/ExactRecord.h), a line each: technique, scenes, pictures, receivers, traced, wrong.
records() {
  awk '
    match($0, /^ *"(technique|scenes|pictures|receivers|traced|wrong)": "/) {
      name = $1; gsub(/[":]/, "", name)
      value[name] = substr($0, RLENGTH + 1); sub(/",?$/, "", value[name])
      if (name == "wrong") {
        print value["technique"] "\t" value["scenes"] "\t" value["pictures"] "\t" value["receivers"] "\t" value["traced"] "\t" value["wrong"]
        delete value
      }
    }' "${reports[@]}"
}

# table HEAD COLUMNS : sums of the records read, by these columns
table() {
  awk -F'\t' -v head="$1" -v columns="$2" '
    BEGIN {
      count = split(columns, by, ",")
      print "| " head " | pictures | receivers compared | traced | wrong pixels |"
      for (i = 1; i <= count; ++i) printf "|---"
      print "|---|---|---|---|"
    }
    {
      key = $(by[1])
      for (i = 2; i <= count; ++i) key = key " | " $(by[i])
      if (!(key in pictures)) order[++keys] = key
      pictures[key] += $3; receivers[key] += $4; traced[key] += $5; wrong[key] += $6
    }
    END {
      for (k = 1; k <= keys; ++k) {
        key = order[k]
        share = receivers[key] > 0 ? 100 * traced[key] / receivers[key] : 0
        printf "| %s | %d | %d | %.1f %% | %d |\n", key, pictures[key], receivers[key], share, wrong[key]
      }
    }'
}

farAway="far away or at other scales"
anywhere="from anywhere"
for kind in "$farAway" "$anywhere"; do
  if [ "$(records | grep -c "$kind")" = 0 ]; then
    echo "No pictures $kind were compared." >&2
    exit 1
  fi
done
{
  echo "# Exact techniques against ray tracing"
  echo
  echo "Written by \`docs/exactness.sh $runs\`. Differs, and wrong, is any visibility that is not that of \`raytraced\`."
  echo
  echo "## Built-in scenes"
  echo
  echo "Pixels that were traced, in per cent of those that face the light; all pixels of the visibility are compared. 1024 x 1024 pixels and"
  echo "maps of 1024, but for maps of other sizes: 512 x 512 pixels; the city: 200 x 200. Fan is \`crsma\` with \`adjacency_ring\` \`vertices\`; \`selective\` is"
  echo "without coherence, the contour all of the picture."
  echo
  cat "$pictures/hard.md"
  echo
  echo "Rays that the GPU's tracer traces (\`raytraced --tracer gpu\`), 1024 x 1024 pixels, against Embree's. They may differ where a ray passes an edge to"
  echo "within a rounding, of all scenes' together one in a million; before foliage more do than elsewhere:"
  echo
  cat "$pictures/tracers.md"
  echo
  echo "Soft shadows, 64 samples: 1024 x 1024 pixels under lamps of their own and with \`light_radius\` 5, and 512 x 512 pixels with 0.5. Traced are pixels"
  echo "all of whose rays were."
  echo
  cat "$pictures/soft.md"
  echo
  echo "## Random scenes"
  echo
  echo "Pictures of 96 x 96 pixels, each with a camera, a light, a projection"
  echo "and a map of 16 to 512 texels of its own (\`tests/unit/truth/RandomScenes.cpp\`). Receivers are the pixels that have a"
  echo "shadow ray; traced is the share of those that the technique traced."
  echo
  records | grep -v "$farAway\|$anywhere" | table technique 1
  echo
  echo "Other pictures, of scenes far away from the origin or at scales of 1e-4 and 1e4:"
  echo
  records | grep "$farAway" | table technique 1
  echo
  echo "## Built-in scenes from anywhere"
  echo
  echo "Pictures of 256 x 256 pixels of built-in scenes, with maps of 64 to 4096 texels; cameras are in and around the scene at random, inside of things, too, and look anywhere into"
  echo "it; lights come from any direction, and lamps stand anywhere. Each technique gets the same cameras and lights."
  echo
  records | grep "$anywhere" | table technique 1
  echo
  echo "## Kinds of scenes"
  echo
  records | grep -v "$farAway\|$anywhere" | table "technique | scenes" 1,2
} > "$pictures/page.md"
mv "$pictures/page.md" docs/exactness.md
exit "$failed"
