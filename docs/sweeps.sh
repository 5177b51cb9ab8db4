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

frames=0
# compare NAME SCENE OPTION... : into $out/NAME; without times where nobody asks for them
compare() {
  compareOnce "$out/$1" "$2" --frames "$frames" --route image "${@:3}"
}

# What is timed comes first: a machine that is quiet needs to be so for a quarter of an hour only. Where the light moves, maps
# are drawn in every frame, as asked for by bake=always, without which crsm and its kin trace all till it rests.
timedViews=(bench-side atrium)
timedCells=(1024x1024.512 1024x1024.1024 1024x1024.2048 1024x1024.4096 512x512.1024 1920x1080.1024)
timed=nsm,coherence,selective
for hybrid in crsm:as_published=on crsm crsma:as_published=on crsma silhouette silhouette:fit=once; do
  timed+=",$hybrid:bake=always"
done
for view in "${timedViews[@]}"; do
  for cell in "${timedCells[@]}"; do
    frames=5 compare "$view.timed-$cell" "$view" --techniques "$timed" --map-sizes "${cell#*.}" --size "${cell%.*}"
  done
done
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

# The 72 cases of the selective chain: twelve views, two maps, three widths of the contour. Then its stages by themselves,
# where what is left is lit, all of them so, and without hints, where only what is outside of the contour is wrong.
chainViews=("${views[@]:0:9}" primitives posts cube)
chains=
for width in 2 4 6; do
  chains+="${chains:+,}selective:contour=$width"
done
for view in "${chainViews[@]}"; do
  for map in 1024 2048; do
    compare "$view.chain.$map" "$view" --techniques "nsm,$chains" --map-sizes "$map"
  done
done
for width in 4 2 6; do
  chain="selective:contour=$width"
  stages="$chain:coherence=off,$chain:leftovers=lit"
  for stage in neighbours={1,4,9}:adjacency=off neighbours=off:adjacency={edges,vertices}; do
    stages+=",$chain:coherence=off:$stage:leftovers=lit"
  done
  for view in "${chainViews[@]}"; do
    for map in 1024 2048; do
      compare "$view.stages-$width.$map" "$view" --techniques "nsm,$stages" --map-sizes "$map"
    done
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

# Per method and cell of a view: the time of drawing maps and that from receivers to visibility.
# cells VIEW MOTION
cells() {
  local columns=variant stage
  for stage in maps "visibility: estimate" "visibility: read receivers" "visibility: build" "visibility: trace" "visibility: upload"; do
    columns+=",$2_${stage}_ms"
  done
  rows "$columns" | awk -F, -v view="$1" -v cells="${timedCells[*]}" '
    $1 == view && $2 ~ /^timed-/ {
      sub(/timed-/, "", $2); sub(/ [0-9]+( image)?$/, "", $4); sub(/ bake=always/, "", $4)
      if ($4 ~ /plain VTK|vtkShadowMapPass/) next
      if (!($4 in seen)) { seen[$4] = 1; order[++count] = $4 }
      time[$4, $2 "." $3] = sprintf("%.1f + %.1f", $5, $6 + $7 + $8 + $9 + $10)
    }
    END {
      cellCount = split(cells, cell, " ")
      printf "|"
      for (i = 1; i <= cellCount; ++i) { split(cell[i], part, "."); printf " | %s, map %s", part[1], part[2] }
      printf " |\n|---"; for (i = 1; i <= cellCount; ++i) printf "|---"; print "|"
      for (k = 1; k <= count; ++k) {
        printf "| `%s`", order[k]
        for (i = 1; i <= cellCount; ++i) printf " | %s", time[order[k], cell[i]]
        print " |"
      }
    }'
}

# The least and the most that the stages make up of a frame, of what is timed with several frames.
stageShares() {
  rows static_stage_share,camera_moving_stage_share,light_moving_stage_share | awk -F, '
    $2 ~ /^timed-/ || ($2 == "1024x1024" && $3 == 1024) {
      for (i = 4; i <= 6; ++i) if ($i != "") {
        if (!count++ || $i < least) least = $i
        if ($i > most) most = $i
        within += $i >= 0.9
      }
    }
    END { printf "Stages make up %.3f to %.3f of a frame, and nine tenths or more in %d of %d cases.\n", least, most, within, count }'
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
    $2 ~ /^[0-9]+x[0-9]+$/ && $6 != "" {
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
      split("coherence;" published ";" publishedA ";crsm;crsma;silhouette;silhouette fit=once", hybrids, ";")
      for (view in views) for (i = 1; i in hybrids; ++i) {
        name = hybrids[i]
        for (map = 1024; map <= 2048; map *= 2)
          check("traced pixels fall with the map'"'"'s size, from 1024 on", traced[view, "1024x1024", 2 * map, name] < traced[view, "1024x1024", map, name], "`" name "` " place(view, "", 2 * map))
        points = 100 * abs(traced[view, "512x512", 1024, name] / facing[view, "512x512"] - traced[view, "1024x1024", 1024, name] / facing[view, "1024x1024"])
        check("the share of traced pixels is the same in 512 x 512 and 1024 x 1024 pixels, within 0.3 points", points <= 0.3, sprintf("`%s` %s (%.1f points)", name, view, points))
      }
      for (view in views) for (map = 512; map <= 2048; map *= 2)
        check("`crsm` as published has more wrong pixels with a larger map", wrong[view, "1024x1024", 2 * map, published] >= wrong[view, "1024x1024", map, published], place(view, "", 2 * map))
      for (i = 1; i <= statements; ++i)
        printf "| %s | %d of %d | %s%s |\n", order[i], held[order[i]], cases[order[i]], not[order[i]], (failures[order[i]] > 4 ? "; ..." : "")
    }'
  chainOrderings
}

# The same of the chain and its stages: orderings of Moderno's tables.
chainOrderings() {
  local columns="variant,wrong_pixels,traced_pixels,facing_pixels" class
  for class in "hinted lit" "hinted in shadow" "confirmed by its texel" "confirmed by neighbours" "confirmed by adjacency" \
    corrected "traced lit by its texel" "traced in shadow by its texel"; do
    columns+=",class ${class}_pixels"
  done
  rows "$columns" | awk -F, '
    function check(name, holds, where) {
      if (!(name in cases)) order[++statements] = name
      cases[name]++
      if (holds) held[name]++
      else if (++failures[name] <= 4) not[name] = not[name] (not[name] ? "; " : "") where
    }
    # Of views in their order, so that those that are named are always the same.
    $2 == "chain" || $2 ~ /^stages-/ {
      sub(/ [0-9]+( image)?$/, "", $4)
      if ($4 !~ /^(nsm|selective)/) next
      if (!($1 in known)) { known[$1] = 1; views[++viewCount] = $1 }
      if ($4 == "nsm") { plain[$1, $3] = $5; next }
      width = $4; sub(/.*contour=/, "", width); sub(/ .*/, "", width)
      if ($2 == "chain") {
        contour = $8 + $9 + $10 + $11 + $12 + $13 + $14 + $15
        wrong[$1, $3, width] = $5; left[$1, $3, width] = $6
        hintShare[$1, $3, width] = ($8 + $9) / contour
        leftShare[$1, $3, width] = $6 / contour
        lit[$1, $3, width] = $14; shadow[$1, $3, width] = $15
        litShare[$1, $3, width] = $14 / ($8 + $13 + $14)
        shadowShare[$1, $3, width] = $15 / ($9 + $10 + $11 + $12 + $15)
        allLit += $14; allShadow += $15
        next
      }
      # Without hints what is wrong is outside of the contour.
      if ($4 == "selective coherence=off contour=" width) outside[$1, $3, width] = $5
      if ($4 == "selective contour=" width " leftovers=lit") leftLit[$1, $3, width] = $5
      stage = $4 ~ /neighbours=1/ ? "ST" : $4 ~ /neighbours=4/ ? "N4" : $4 ~ /neighbours=9/ ? "N9" : \
        $4 ~ /adjacency=edges/ ? "A1" : $4 ~ /adjacency=vertices/ ? "A2" : ""
      if (stage == "") next
      alone[$1, $3, width, stage] = $5; confirmed[$1, $3, width, stage] = $10 + $11 + $12
      measured[$1, $3, width] = 1
    }
    END {
      for (v = 1; v <= viewCount; ++v) {
        view = views[v]
        check("`nsm`: twice the map (2048 for 1024) leaves 0.49 to 0.61 of its wrong pixels", \
          plain[view, 2048] >= 0.485 * plain[view, 1024] && plain[view, 2048] < 0.615 * plain[view, 1024], \
          sprintf("%s (%.2f)", view, plain[view, 2048] / plain[view, 1024]))
        for (width = 2; width <= 6; width += 2) {
          where = view " contour " width
          check("`selective`, twice the map: a larger share of the contour is hinted", hintShare[view, 2048, width] > hintShare[view, 1024, width], where)
          check("`selective`, twice the map: a smaller share of the contour is left", leftShare[view, 2048, width] < leftShare[view, 1024, width], where)
        }
        for (map = 1024; map <= 2048; map *= 2) {
          where = view " " map
          check("`selective`, a wider contour: more pixels are left", left[view, map, 2] < left[view, map, 4] && left[view, map, 4] < left[view, map, 6], where)
          check("`selective`, a wider contour: a smaller share of it is left", leftShare[view, map, 2] > leftShare[view, map, 4] && leftShare[view, map, 4] > leftShare[view, map, 6], where)
          check("`selective`, a wider contour: a larger share of it is hinted", hintShare[view, map, 2] < hintShare[view, map, 4] && hintShare[view, map, 4] < hintShare[view, map, 6], where)
          check("`selective`, a wider contour: no more wrong pixels in the picture", wrong[view, map, 2] >= wrong[view, map, 4] && wrong[view, map, 4] >= wrong[view, map, 6], where)
          check("`selective`, 4 pixels: at most a tenth of the map'"'"'s wrong pixels are left", wrong[view, map, 4] <= 0.1 * plain[view, map], where)
          for (width = 2; width <= 6; width += 2) {
            where = view " " map " contour " width
            check("`selective`: more pixels are left that are lit by their texel than in shadow", lit[view, map, width] > shadow[view, map, width], where)
            check("`selective`: of those that are lit by their texel, a larger share is left than of those in shadow", litShare[view, map, width] > shadowShare[view, map, width], where)
            if (!((view, map, width) in measured)) continue
            before = plain[view, map] - outside[view, map, width]; after = leftLit[view, map, width] - outside[view, map, width]
            check("the whole chain, the rest lit: at most 0.61 of the wrong pixels that `nsm` has in the contour", after <= 0.61 * before, sprintf("%s (%.2f)", where, after / before))
            st = alone[view, map, width, "ST"]; n4 = alone[view, map, width, "N4"]; n9 = alone[view, map, width, "N9"]
            a1 = alone[view, map, width, "A1"]; a2 = alone[view, map, width, "A2"]
            check("one stage, the rest lit: nine texels leave no more wrong pixels than four, four no more than one", n9 <= n4 && n4 <= st, where)
            check("one stage, the rest lit: `vertices` leaves no more wrong pixels than `edges`, `edges` no more than its texel alone", a2 <= a1 && a1 <= st, where)
            check("one stage, the rest lit: `vertices` confirms more pixels than nine texels", confirmed[view, map, width, "A2"] > confirmed[view, map, width, "N9"], where)
            check("one stage, the rest lit: nine texels leave fewer wrong pixels than `vertices`", n9 < a2, where)
          }
        }
      }
      for (i = 1; i <= statements; ++i)
        printf "| %s | %d of %d | %s%s |\n", order[i], held[order[i]], cases[order[i]], not[order[i]], (failures[order[i]] > 4 ? "; ..." : "")
      printf "\nPixels that `selective` leaves: %.2f that are lit by their texel to 1 in shadow.\n", allShadow ? allLit / allShadow : 0
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
  echo "## Time over maps and pictures, light moving"
  echo
  echo "Maps drawn + from receivers to visibility, in milliseconds, medians of 5 frames. \`nsm\` looks up on the (software) GPU; with"
  echo "\`bake\` \`always\`, by which \`crsm\` and its kin draw their maps while the light moves, too."
  for view in "${timedViews[@]}"; do
    echo
    echo "### $view"
    echo
    cells "$view" light_moving
  done
  echo
  stageShares
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
  echo "On the cube and the primitives a contour of 2 pixels has all that is left already, but for 25 pixels."
  echo
  echo "More than a tenth of the wrong pixels is left where leaves and blades are finer than texels: what the map has not seen has no contour there."
} > "$out/page.md"
mv "$out/page.md" docs/sweeps.md
