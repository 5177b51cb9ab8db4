#!/bin/bash
# Sweeps the hybrid techniques over maps, pictures and views, as the theses that they come from did on their own
# scenes, and writes docs/sweeps.md. Takes about an hour; what the same program has measured in the same way before, in
# out/sweeps, is not measured again.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source cmake/debian.sh
source docs/comparisons.sh

install_packages
build release

views=(bench-with bench-side bench-against trees-with trees-side trees-against
  flowers-with flowers-side flowers-against atrium)
hybrids=coherence,crsm:as_published=on,crsm,crsma:as_published=on,crsma,silhouette,silhouette:fit=once
out=out/sweeps
mkdir -p "$out"

frames=1
# compare NAME SCENE OPTION... : into $out/NAME; one frame where nobody asks for times
compare() {
  compareOnce "$out/$1" "$2" --frames "$frames" --route image "${@:3}"
}

# What is timed comes first: a machine that is quiet needs to be so for a few minutes only.
for view in "${views[@]}"; do
  frames=9 compare "$view.1024x1024.1024" "$view" --techniques "nsm,$hybrids" --map-sizes 1024
done
for view in "${views[@]}"; do
  for map in 512 2048 4096; do
    compare "$view.1024x1024.$map" "$view" --techniques "nsm,$hybrids" --map-sizes "$map"
  done
  for size in 512x512 1920x1080; do
    compare "$view.$size.1024" "$view" --techniques "nsm,$hybrids" --map-sizes 1024 --size "$size"
  done
done

# The 72 cases of the selective chain: twelve views, two maps, three widths of the contour.
chains=
for width in 2 4 6; do
  chains+="${chains:+,}selective:contour=$width"
done
for view in "${views[@]:0:9}" primitives posts cube; do
  for map in 1024 2048; do
    compare "$view.chain.$map" "$view" --techniques "nsm,$chains" --map-sizes "$map"
  done
done

# Rows of all runs, of columns by their names (without commas), behind view, picture and map.
rows() {
  local run
  for run in "$out"/*/results.csv; do
    run="$(basename "$(dirname "$run")")"
    results "$out/$run" | awk -F, -v run="$run" -v wanted="$1" '
      BEGIN { split(run, part, "."); count = split(wanted, names, ",") }
      NR == 1 { for (i = NF; i >= 1; --i) column[$i] = i; next }
      {
        printf "%s,%s,%s", part[1], part[2], part[3]
        for (i = 1; i <= count; ++i) printf ",%s", (names[i] in column) ? $(column[names[i]]) : ""
        printf "\n"
      }'
  done
}

# table TITLE PICTURE MAPS : share of traced pixels and wrong pixels of each variant, mean over the views
uncertain() {
  rows variant,facing_pixels,wrong_pixels,traced_pixels | awk -F, -v picture="$1" '
    $2 == picture {
      sub(/ [0-9]+( image)?$/, "", $4)
      if (!($4 in seen)) { seen[$4] = 1; order[++count] = $4 }
      if (!($3 in maps)) { maps[$3] = 1; sizes[++sizeCount] = $3 + 0 }
      views[$4, $3]++; traced[$4, $3] += 100 * $7 / $5; wrong[$4, $3] += $6
    }
    END {
      for (i = 1; i <= sizeCount; ++i) for (j = i + 1; j <= sizeCount; ++j)
        if (sizes[j] < sizes[i]) { swap = sizes[i]; sizes[i] = sizes[j]; sizes[j] = swap }
      printf "|"; for (i = 1; i <= sizeCount; ++i) printf " | map %d: traced, wrong", sizes[i]; print " |"
      printf "|---"; for (i = 1; i <= sizeCount; ++i) printf "|---"; print "|"
      for (k = 1; k <= count; ++k) {
        name = order[k]
        if (name ~ /plain VTK|vtkShadowMapPass|raytraced/) continue
        printf "| `%s`", name
        for (i = 1; i <= sizeCount; ++i)
          if ((name, sizes[i]) in views)
            printf " | %.1f %%, %d", traced[name, sizes[i]] / views[name, sizes[i]], wrong[name, sizes[i]] / views[name, sizes[i]]
          else printf " | "
        print " |"
      }
    }'
}

columns=variant
for stage in "visibility: read receivers" "visibility: trace" "visibility: upload" maps; do
  columns+=",camera_moving_${stage}_ms"
done

# The time from receivers to visibility of each variant over that of raytraced, mean over the views.
times() {
  rows "$columns" | awk -F, -v picture="$1" -v map="$2" '
    $2 == picture && $3 == map {
      sub(/ [0-9]+( image)?$/, "", $4)
      sum = $5 + $6 + $7 + $8
      if ($5 == "") next
      if (!($4 in seen)) { seen[$4] = 1; order[++count] = $4 }
      time[$4, $1] = sum; read[$4] += $5; trace[$4] += $6; upload[$4] += $7; views[$4]++
      if ($4 == "raytraced") truth[$1] = sum
      all[$1] = 1
    }
    END {
      print "| | read back | decided and traced | uploaded | over `raytraced` |"
      print "|---|---|---|---|---|"
      for (k = 1; k <= count; ++k) {
        name = order[k]
        ratio = 0; n = 0
        for (view in all) if ((name, view) in time && truth[view] > 0) { ratio += time[name, view] / truth[view]; ++n }
        if (n > 0 && name !~ /nsm/)
          printf "| `%s` | %.1f ms | %.1f ms | %.1f ms | %.2f |\n", name, read[name] / views[name], trace[name] / views[name], upload[name] / views[name], ratio / n
      }
    }'
}

# What became of the pixels of the contour, per view and case.
chain() {
  rows variant,facing_pixels,wrong_pixels,traced_pixels | awk -F, '
    $2 == "chain" && $4 ~ /^(nsm|selective)/ {
      sub(/ [0-9]+( image)?$/, "", $4); sub(/selective contour=/, "", $4)
      wrong[$1, $3, $4] = $6; traced[$1, $3, $4] = $7; facing[$1] = $5; views[$1] = 1
    }
    END {
      print "| view | map | `nsm`: wrong | 2 pixels: wrong, traced | 4 pixels | 6 pixels |"
      print "|---|---|---|---|---|---|"
      for (view in views) for (map = 1024; map <= 2048; map += 1024) {
        printf "| %s | %d | %d", view, map, wrong[view, map, "nsm"]
        for (width = 2; width <= 6; width += 2)
          printf " | %d, %.2f %%", wrong[view, map, width], 100 * traced[view, map, width] / facing[view]
        print " |"
      }
    }' | (read -r head; read -r line; printf '%s\n%s\n' "$head" "$line"; sort)
}

# In how many cases what the theses' tables show is so here as well.
orderings() {
  echo "| | holds in | else |"
  echo "|---|---|---|"
  rows variant,wrong_pixels,traced_pixels,facing_pixels | awk -F, '
    # case NAME HOLDS WHERE: counts; keeps the first cases in which it does not hold
    function check(name, holds, where) {
      if (!(name in cases)) order[++statements] = name
      cases[name]++
      if (holds) held[name]++
      else if (++failures[name] <= 4) not[name] = not[name] (not[name] ? "; " : "") where
    }
    function place(view, picture, map) { return view " " (picture == "chain" ? "" : picture " ") map }
    function abs(x) { return x < 0 ? -x : x }
    $2 != "chain" && $6 != "" {
      sub(/ [0-9]+( image)?$/, "", $4)
      wrong[$1, $2, $3, $4] = $5; traced[$1, $2, $3, $4] = $6; facing[$1, $2] = $7
      runs[$1, $2, $3] = 1; names[$4] = 1; views[$1] = 1
    }
    END {
      published = "crsm as_published=on"; publishedA = "crsma as_published=on"
      for (run in runs) {
        split(run, part, SUBSEP)
        where = place(part[1], part[2], part[3])
        check("`coherence` traces less than `crsma` as published", traced[run, "coherence"] < traced[run, publishedA], where)
        check("`crsma` as published traces no more than `crsm` as published", traced[run, publishedA] <= traced[run, published], where)
        check("`crsma` traces no more than `crsm`", traced[run, "crsma"] <= traced[run, "crsm"], where)
        check("`silhouette` traces no more than `crsma`", traced[run, "silhouette"] <= traced[run, "crsma"], where)
        check("`crsm`, `crsma`, `silhouette`: no wrong pixel", wrong[run, "crsm"] + wrong[run, "crsma"] + wrong[run, "silhouette"] + wrong[run, "silhouette fit=once"] == 0, where)
        check("`coherence` has fewer wrong pixels than `nsm`", wrong[run, "coherence"] < wrong[run, "nsm"], where)
      }
      split("coherence;" published ";" publishedA ";crsm;crsma;silhouette", hybrids, ";")
      for (view in views) for (i = 1; i in hybrids; ++i) {
        name = hybrids[i]
        for (map = 1024; map <= 2048; map *= 2)
          check("traced pixels fall with the map'"'"'s size, from 1024 on", traced[view, "1024x1024", 2 * map, name] < traced[view, "1024x1024", map, name], "`" name "` " place(view, "", 2 * map))
        small = traced[view, "512x512", 1024, name] / facing[view, "512x512"]; large = traced[view, "1024x1024", 1024, name] / facing[view, "1024x1024"]
        check("the share of traced pixels is the same in 512 x 512 and 1024 x 1024 pixels, within 5 %", abs(small - large) <= 0.05 * large, "`" name "` " view)
      }
      for (view in views) for (map = 512; map <= 2048; map *= 2)
        check("`crsm` as published has more wrong pixels with a larger map", wrong[view, "1024x1024", 2 * map, published] >= wrong[view, "1024x1024", map, published], place(view, "", 2 * map))
      for (i = 1; i <= statements; ++i)
        printf "| %s | %d of %d | %s%s |\n", order[i], held[order[i]], cases[order[i]], not[order[i]], (failures[order[i]] > 4 ? "; ..." : "")
    }'
  rows "variant,wrong_pixels,traced_pixels,class traced lit by its texel_pixels,class traced in shadow by its texel_pixels" | awk -F, '
    $2 == "chain" {
      sub(/ [0-9]+( image)?$/, "", $4)
      if ($4 == "nsm") plain[$1, $3] = $5
      if ($4 !~ /^selective/) next
      sub(/selective contour=/, "", $4)
      wrong[$1, $3, $4] = $5; traced[$1, $3, $4] = $6; lit += $7; shadow += $8; runs[$1, $3] = 1; ++cases; more += $7 > $8
    }
    END {
      for (run in runs) {
        ++count; wider += traced[run, 2] <= traced[run, 4] && traced[run, 4] <= traced[run, 6]; fewer += wrong[run, 2] >= wrong[run, 4] && wrong[run, 4] >= wrong[run, 6]
        mended += wrong[run, 4] <= 0.1 * plain[run]
      }
      printf "| `selective`: a wider contour traces no less | %d of %d | |\n", wider, count
      printf "| `selective`: a wider contour leaves no more wrong pixels | %d of %d | |\n", fewer, count
      printf "| `selective`, 4 pixels: at most a tenth of the map'"'"'s wrong pixels are left | %d of %d | |\n", mended, count
      printf "| `selective`: more pixels are traced that are lit by their texel than in shadow | %d of %d | of all: %.2f to 1 |\n", more, cases, shadow ? lit / shadow : 0
    }'
}

{
  echo "# Sweeps over maps, pictures and views"
  echo
  echo "Written by \`docs/sweeps.sh\`, on: $(machine). Means over ten views: the garden's nine sides and the"
  echo "atrium. Traced is the share of the pixels that face the light; wrong pixels are in pixels."
  for size in 512x512 1024x1024 1920x1080; do
    echo
    echo "## $size pixels"
    echo
    uncertain "$size"
  done
  echo
  echo "## Time, 1024 x 1024 pixels, maps of 1024, camera moving, light static"
  echo
  times 1024x1024 1024
  echo
  echo "## The selective chain"
  echo
  echo "Wrong pixels of the map and of the chain (default settings), and the share of the pixels that face the light that it traces."
  echo
  chain
  echo
  echo "## What the theses' tables show, here"
  echo
  echo "Cases are views, pictures and maps; those where a statement does not hold are named, the first four of them."
  echo
  orderings
  echo
  echo "Cloths of the atrium hang almost along the light. Whether they are decided depends on how far off them rays begin, a share of the pixel's size: in"
  echo "512 x 512 pixels more of them are."
  echo
  echo "More than a tenth of the wrong pixels is left where leaves and blades are finer than texels: what the map has not seen has no contour there."
} > "$out/page.md"
mv "$out/page.md" docs/sweeps.md
