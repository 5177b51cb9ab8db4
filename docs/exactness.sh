#!/bin/bash
# Compares the exact techniques with ray tracing on the built-in scenes and on random pictures, and writes docs/exactness.md.
# Usage: docs/exactness.sh [RUNS [PART...]]
# PART: random, anywhere, scenes, tracers or soft, a section of the page each, which says of which commit it is; all of them if none is named.
# RUNS: of `random`, pictures of each of 16 kinds of scenes, each with a camera and a light of its own. One light in six shines straight
# down: with 100, each technique sees 1,600 cameras and more than 1,000 lights that do not. Of `anywhere`, pictures of each of ten built-in scenes, from
# anywhere, in any light: with 100, 1,000 cameras and lights.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source cmake/debian.sh

runs="${1:-300}"
parts=("${@:2}")
[ "${#parts[@]}" -gt 0 ] || parts=(random anywhere scenes tracers soft)
for part in "${parts[@]}"; do
  if ! grep -qx "<!-- $part -->" docs/exactness.md; then
    echo "There is no part $part: docs/exactness.md has no section of that name." >&2
    exit 1
  fi
done
commit="$(git rev-parse --short HEAD)"
git diff --quiet HEAD -- . ':!docs' || commit+=", with changes"
install_packages
build release

# A section also says what is wrong, so that it is written in any case.
failed=0
mkdir -p out
pictures="$(mktemp -d out/exactness.XXXXXX)" # its own, so that parts may be made at the same time
trap 'rm -rf "$pictures"' EXIT

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

# Parts: each prints its tables.

scenes() {
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
}

# Rays by the GPU's tracer against Embree's: the same, but for those that pass an edge to within a rounding, one in a million at most.
tracers() {
  local rays differing allRays=0 allDiffering=0
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
  [ "$allDiffering" -le $((allRays / 1000000)) ] || failed=1
}

soft() {
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
}

# compareRandom TESTS FILTER : runs them, with their records in $report
report="$pictures/records.json"
compareRandom() {
  rm -f "$report"
  env -u DISPLAY GNOMON_EXACT_RUNS="$runs" "build/release/bin/gnomon_test_$1" --gtest_filter="$2" --gtest_output="json:$report" >&2 || failed=1
  [ -e "$report" ]
}

# What tests recorded (tests/unit/truth/ExactRecord.h), a line each: technique, scenes, pictures, receivers, traced, wrong.
records() {
  awk '
    match($0, /^ *"([a-z]+\.)?(technique|scenes|pictures|receivers|traced|wrong)": "/) {
      name = $1; gsub(/[":]/, "", name); sub(/^.*\./, "", name)
      value[name] = substr($0, RLENGTH + 1); sub(/",?$/, "", value[name])
      if (name == "wrong") {
        print value["technique"] "\t" value["scenes"] "\t" value["pictures"] "\t" value["receivers"] "\t" value["traced"] "\t" value["wrong"]
        delete value
      }
    }' "$report"
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

random() {
  compareRandom truth '*ConservativeMapsIn.*:*ConservativeMapsOnGpu.*:*ConservativeMapsAnywhere.*:*ChainIn.*:Chain.isNeverWrong*:*RandomPenumbras.*'
  if [ "$(records | grep -c "$farAway")" = 0 ]; then
    echo "No pictures $farAway were compared." >&2
    return 1
  fi
  records | grep -v "$farAway" | table technique 1
  echo
  echo "Other pictures, of scenes far away from the origin or at scales of 1e-4 and 1e4:"
  echo
  records | grep "$farAway" | table technique 1
  echo
  echo "By kinds of scenes:"
  echo
  records | grep -v "$farAway" | table "technique | scenes" 1,2
}

anywhere() {
  compareRandom plugin '*ExactScenesFromAnywhere.*'
  records | table technique 1
}

# put PART FILE : the file's text into the part's section of the page
put() {
  awk -v begin="<!-- $1 -->" -v end="<!-- end of $1 -->" -v text="$2" '
    $0 == end { skip = 0 }
    !skip { print }
    $0 == begin {
      print ""
      while ((getline line < text) > 0) print line
      print ""
      skip = 1
    }' docs/exactness.md > "$pictures/page.md"
  mv "$pictures/page.md" docs/exactness.md
}

for part in "${parts[@]}"; do
  {
    echo "\`docs/exactness.sh $runs $part\`, commit $commit:"
    echo
    "$part"
  } > "$pictures/$part.md"
  put "$part" "$pictures/$part.md"
done
exit "$failed"
