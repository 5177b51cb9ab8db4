#!/bin/bash
# Measures montecarlo over maps, pictures, rays and searches, as the tables 4.1 to 4.4 of Curtis' thesis do, and writes
# docs/montecarlo_tables.md. Takes about ten minutes; what the same program has measured in the same way before, in out/montecarlo, is not
# measured again.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source docs/comparisons.sh
prepare

out=out/montecarlo
mkdir -p "$out"

# By search and rays along either side of the light: the two that the thesis has, and the default here.
techniques=
for rays in 2 3; do
  techniques+="montecarlo:mc_layers=near_far:mc_rays=$rays,"
  techniques+="montecarlo:mc_layers=eye:mc_search=linear:mc_rays=$rays,"
  techniques+="montecarlo:mc_rays=$rays,"
done
techniques="${techniques%,}"

# compare SCENE SIZE MAPS OPTION... : into $out/SCENE.SIZE
compare() {
  compareOnce "$out/$1.$2" "$1" --techniques "$techniques" --size "$2" --map-sizes "$3" --frames 1 --truth-samples 64 "${@:4}"
}

# A body with fine detail and the elongated cube, in place of the thesis' dragon and its cube. Pictures have half the width and the height
# of those in the thesis, 1024 x 768, 800 x 600 and 1280 x 1024: a quarter of the time where OpenGL draws by software.
main=512x384
pictures="400x300 $main 640x512"
for size in $main 400x300 640x512; do
  maps=512
  if [ "$size" = "$main" ]; then
    maps=256,512,1024
  fi
  compare bunny "$size" "$maps" --light-radius 5
  compare soft-long-cube "$size" "$maps"
done

# Of all runs: scene, picture, map, search (published: hier or lin; ours: peeled), rays, milliseconds, mean absolute error.
rows() {
  local run
  for run in "$out"/*/results.csv; do
    run="$(basename "$(dirname "$run")")"
    results "$out/$run" | awk -F, -v run="$run" '
      BEGIN { split(run, part, ".") }
      NR == 1 { for (i = NF; i >= 1; --i) column[$i] = i; next }
      $1 ~ /^montecarlo/ {
        search = $1 ~ /linear/ ? "lin" : $1 ~ /near_far/ ? "hier" : "peeled"
        rays = $1 ~ /mc_rays=2/ ? 2 : 3
        print part[1] "," part[2] "," $(column["map_size"]) "," search "," rays "," $(column["camera_moving_ms"]) "," $(column["mean_absolute_error"])
      }'
  done
}

# table SCENE COLUMN WHERE VALUES : times by search and rays, over maps (3) or pictures (2), where the other column is as given
table() {
  rows | awk -F, -v scene="$1" -v column="$2" -v where="$3" -v values="$4" '
    BEGIN {
      count = split(values, value, " ")
      printf "| search | rays"
      for (i = 1; i <= count; ++i) printf " | %s", value[i]
      printf " |\n|---|---"
      for (i = 1; i <= count; ++i) printf "|---"
      print "|"
    }
    $1 == scene && $(5 - column) == where { ms[$4, $5, $column] = $6; mae[$4, $5, $column] = $7 }
    END {
      split("hier lin peeled", searches, " ")
      name["hier"] = "hierarchical, `near_far`"; name["lin"] = "linear, `eye`"; name["peeled"] = "hierarchical, `peeled`"
      for (s = 1; s <= 3; ++s) for (rays = 2; rays <= 3; ++rays) {
        printf "| %s | %d x %d", name[searches[s]], rays, rays
        for (i = 1; i <= count; ++i) {
          at = searches[s] SUBSEP rays SUBSEP value[i]
          if (at in ms) printf " | %.0f ms (%.1f fps), %.4f", ms[at], 1000 / ms[at], mae[at]; else printf " | "
        }
        print " |"
      }
    }'
}

# In how many cells of the tables what the thesis concludes (section 4.2) is so here as well.
relations() {
  echo "| | holds in | least to most |"
  echo "|---|---|---|"
  rows | awk -F, -v main="$main" '
    # check NAME RATIO LIMIT: counts a ratio that is below the limit
    function check(name, ratio, limit) {
      if (!(name in cases)) { order[++names] = name; least[name] = ratio; most[name] = ratio }
      ++cases[name]
      if (ratio < limit) ++held[name]
      if (ratio < least[name]) least[name] = ratio
      if (ratio > most[name]) most[name] = ratio
    }
    { ms[$1, $2, $3, $4, $5] = $6; mae[$1, $2, $3, $4, $5] = $7; runs[$1, $2, $3] = 1 }
    END {
      for (run in runs) {
        split(run, part, SUBSEP)
        for (rays = 2; rays <= 3; ++rays) {
          check("hierarchical search is faster than linear: its time over that", ms[run, "hier", rays] / ms[run, "lin", rays], 1)
          check("`peeled` has a smaller error than `near_far`: its error over that", mae[run, "peeled", rays] / mae[run, "hier", rays], 1)
        }
        check("9 rays take less than 9/4 of the time of 4, hierarchical, `near_far`", ms[run, "hier", 3] / ms[run, "hier", 2], 2.25)
        check("9 rays take less than 9/4 of the time of 4, hierarchical, `peeled`", ms[run, "peeled", 3] / ms[run, "peeled", 2], 2.25)
        check("9 rays take less than 9/4 of the time of 4, linear", ms[run, "lin", 3] / ms[run, "lin", 2], 2.25)
        check("9 rays cost the hierarchical search a smaller factor than the linear one: one over the other", (ms[run, "hier", 3] / ms[run, "hier", 2]) / (ms[run, "lin", 3] / ms[run, "lin", 2]), 1)
        if (part[2] == main && part[3] > 256) for (rays = 2; rays <= 3; ++rays) {
          small = part[1] SUBSEP part[2] SUBSEP part[3] / 2
          check("a larger map costs the hierarchical search a larger factor than the linear one: linear over hierarchical", (ms[run, "lin", rays] / ms[small, "lin", rays]) / (ms[run, "hier", rays] / ms[small, "hier", rays]), 1)
        }
      }
      for (i = 1; i <= names; ++i)
        printf "| %s | %d of %d | %.2f to %.2f |\n", order[i], held[order[i]], cases[order[i]], least[order[i]], most[order[i]]
    }'
}

{
  echo "# The four tables of Curtis' thesis"
  echo
  echo "Written by \`docs/montecarlo_tables.sh\`, on: $(machine). The bunny under a sun of 5 degrees stands for the"
  echo "thesis' dragon, \`soft-long-cube\` is its elongated cube. Times are those of whole frames with a moving camera over a map that stays, all"
  echo "variants of a picture taking turns; behind them the mean absolute error over the pixels that face the light, against \`raytraced\` with 64 samples. The"
  echo "thesis' hierarchical search has two layers, and its linear one the camera's depths as a third; \`peeled\` is what is done"
  echo "[here](techniques/montecarlo.md). Pictures have half the width and height of those in the thesis. All are deferred, as are all techniques on the screen: the thesis' tables have rows without that."
  echo
  echo "## Table 4.1: bunny, ${main/x/ x } pixels, over maps"
  echo
  table bunny 3 "$main" "256 512 1024"
  echo
  echo "## Table 4.2: elongated cube, ${main/x/ x } pixels, over maps"
  echo
  table soft-long-cube 3 "$main" "256 512 1024"
  echo
  echo "## Table 4.3: bunny, maps of 512, over pictures"
  echo
  table bunny 2 512 "$pictures"
  echo
  echo "## Table 4.4: elongated cube, maps of 512, over pictures"
  echo
  table soft-long-cube 2 512 "$pictures"
  echo
  echo "## What the thesis concludes, here"
  echo
  echo "Cases are scenes, pictures, maps and numbers of rays."
  echo
  relations
} > "$out/page.md"
mv "$out/page.md" docs/montecarlo_tables.md
