#!/bin/bash
# Compares the exact techniques with ray tracing on random pictures, and writes docs/exactness.md.
# Usage: docs/exactness.sh [RUNS]
# RUNS pictures of each kind of scene, each with a camera and a light of its own. One light in six shines
# straight down: with 100 and more, each technique sees more than 1,000 directions.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source cmake/debian.sh

runs="${1:-300}"
install_packages
build release

mkdir -p out
report=out/exactness.json
rm -f "$report"
# The page also says what is wrong, so that it is written in any case.
failed=0
env -u DISPLAY GNOMON_EXACT_RUNS="$runs" build/release/bin/gnomon_test_truth \
  --gtest_filter='*ConservativeMapsIn.*:ConservativeMaps.*:*ChainIn.*:Chain.isNeverWrong*:*RandomPenumbras.*' \
  --gtest_output="json:$report" || failed=1
[ -e "$report" ]

# What tests recorded (tests/unit/truth/ExactRecord.h), a line each: technique, scenes, pictures, receivers, traced, wrong.
records() {
  awk '
    match($0, /^ *"(technique|scenes|pictures|receivers|traced|wrong)": "/) {
      name = $1; gsub(/[":]/, "", name)
      value[name] = substr($0, RLENGTH + 1); sub(/",?$/, "", value[name])
      if (name == "wrong")
        print value["technique"] "\t" value["scenes"] "\t" value["pictures"] "\t" value["receivers"] "\t" value["traced"] "\t" value["wrong"]
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
{
  echo "# Exact techniques against ray tracing"
  echo
  echo "Written by \`docs/exactness.sh $runs\`: random pictures of 96 x 96 pixels, each with a camera, a light, a projection"
  echo "and a map of 16 to 512 texels of its own (\`tests/unit/truth/RandomScenes.cpp\`). Receivers are the pixels that have a"
  echo "shadow ray; traced is the share of those that the technique traced. A pixel is wrong where its visibility is not"
  echo "that of \`raytraced\`."
  echo
  records | grep -v "$farAway" | table technique 1
  echo
  echo "Other pictures, of scenes far away from the origin or at scales of 1e-4 and 1e4:"
  echo
  records | grep "$farAway" | table technique 1
  echo
  echo "## Kinds of scenes"
  echo
  records | grep -v "$farAway" | table "technique | scenes" 1,2
} > docs/exactness.md
exit "$failed"
