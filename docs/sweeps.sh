#!/bin/bash
# Sweeps the hybrid techniques over maps, pictures and views, as the theses that they come from did on their own
# scenes, and writes docs/sweeps.md. What the same program has measured in the same way before, in out/sweeps, is not
# measured again.
# Usage: docs/sweeps.sh [counts]
# With `counts` nothing is timed, for which alone a machine needs to be quiet; the page, without times, is out/sweeps/page.md.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source cmake/debian.sh
source docs/comparisons.sh

install_packages
build release

views=(bench-with bench-side bench-against trees-with trees-side trees-against
  flowers-with flowers-side flowers-against atrium)
fan=crsma:adjacency_ring=vertices
hybrids="coherence,crsm:as_published=on,crsm,crsma:as_published=on,crsma,$fan,silhouette,silhouette:fit=once,selective"
out=out/sweeps
mkdir -p "$out"

frames=0
runs=() # those that the page is written from
# compare NAME SCENE OPTION... : into $out/NAME; without times where nobody asks for them
compare() {
  runs+=("$1")
  compareOnce "$out/$1" "$2" --frames "$frames" --route image "${@:3}"
}

# bakeAlways TECHNIQUE,... : `crsm` and its kin so that they draw their maps in every frame in which the light moves,
# without which they trace all till it rests
bakeAlways() {
  local technique list=
  for technique in ${1//,/ }; do
    case "$technique" in crsm*|silhouette*) technique+=":bake=always" ;; esac
    list+="${list:+,}$technique"
  done
  echo "$list"
}

# What is timed comes first: a machine that is quiet needs to be so for that long only.
timedViews=(bench-side atrium)
timedCells=(1024x1024.512 1024x1024.1024 1024x1024.2048 1024x1024.4096 512x512.1024 1920x1080.1024)
cellFrames=5
viewFrames=7
if [ "${1:-}" != counts ]; then
  timed="$(bakeAlways "nsm,${hybrids/$fan,/}")"
  for view in "${timedViews[@]}"; do
    for cell in "${timedCells[@]}"; do
      frames="$cellFrames" compare "$view.timed-$cell" "$view" --techniques "$timed" --map-sizes "${cell#*.}" --size "${cell%.*}"
    done
  done
  timed="$(bakeAlways "nsm,$hybrids")"
  for view in "${views[@]}"; do
    frames="$viewFrames" compare "$view.timed.1024" "$view" --techniques "$timed" --map-sizes 1024
  done
fi

for cell in 1920x1080.1024 1024x1024.{4096,2048,1024,512} 512x512.1024; do
  for view in "${views[@]}"; do
    compare "$view.$cell" "$view" --techniques "nsm,$hybrids" --map-sizes "${cell#*.}" --size "${cell%.*}"
  done
done

# The 72 cases of the selective chain: twelve views, two maps, three widths of the contour. Of each the whole chain; hints
# of nine texels; without hints, where only what is outside of the contour is wrong; what is left lit; and its stages by
# themselves, the rest lit.
chainViews=("${views[@]:0:9}" primitives-with primitives primitives-against)
chains=nsm,coherence
for width in 2 4 6; do
  chain="selective:contour=$width"
  chains+=",$chain,$chain:coherence=9,$chain:coherence=off,$chain:leftovers=lit"
  for stage in neighbours={1,4,9}:adjacency=off neighbours=off:adjacency={edges,vertices}; do
    chains+=",$chain:coherence=off:$stage:leftovers=lit"
  done
done
for map in 2048 1024; do
  for view in "${chainViews[@]}"; do
    compare "$view.chain.$map" "$view" --techniques "$chains" --map-sizes "$map"
  done
done

# The chain on maps that are fitted to what the camera sees, as the thesis' are.
fitted=nsm:fit=once
for width in 2 4 6; do
  fitted+=",selective:fit=once:contour=$width,selective:fit=once:contour=$width:coherence=off"
done
for map in 2048 1024; do
  for view in "${chainViews[@]}"; do
    compare "$view.fitted.$map" "$view" --techniques "$fitted" --map-sizes "$map"
  done
done

# Rows of all runs, of columns by their names (without commas), behind view, picture and map.
rows() {
  local run
  for run in "${runs[@]}"; do
    results "$out/$run" | awk -F, -v run="$run" -v wanted="$1" '
      BEGIN { split(run, part, "."); count = split(wanted, names, ",") }
      NR == 1 { for (i = NF; i >= 1; --i) column[$i] = i; next }
      {
        sub(/ [0-9]+( image)?$/, "", $1); sub(/ bake=always/, "", $1)
        printf "%s,%s,%s", part[1], part[2], part[3]
        for (i = 1; i <= count; ++i) printf ",%s", (names[i] in column) ? $(column[names[i]]) : ""
        printf "\n"
      }'
  done
}

# uncertain PICTURE : share of traced pixels and wrong pixels of each variant, mean over the views
uncertain() {
  rows variant,facing_pixels,wrong_pixels,traced_pixels | awk -F, -v picture="$1" '
    $2 == picture {
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

# The same of each view, of one picture and map: a row a view.
uncertainByView() {
  rows variant,facing_pixels,wrong_pixels,traced_pixels | awk -F, -v picture="$1" -v map="$2" '
    $2 == picture && $3 == map && $4 !~ /plain VTK|vtkShadowMapPass|raytraced/ {
      if (!($4 in seen)) { seen[$4] = 1; order[++count] = $4 }
      if (!($1 in known)) { known[$1] = 1; views[++viewCount] = $1 }
      traced[$1, $4] = 100 * $7 / $5; wrong[$1, $4] = $6
    }
    END {
      printf "|"; for (k = 1; k <= count; ++k) printf " | `%s`", order[k]; print " |"
      printf "|---"; for (k = 1; k <= count; ++k) printf "|---"; print "|"
      for (v = 1; v <= viewCount; ++v) {
        printf "| %s", views[v]
        for (k = 1; k <= count; ++k) {
          cell = views[v] SUBSEP order[k]
          if (order[k] == "nsm") printf " | %d", wrong[cell]
          else printf " | %.1f%s", traced[cell], wrong[cell] > 0 ? ", " wrong[cell] : ""
        }
        print " |"
      }
    }'
}

# Means over the views: what drawing maps takes while the light moves, and, while the camera moves, the time from receivers
# to visibility, also over that of raytraced.
times() {
  local columns=variant,light_moving_maps_ms stage
  for stage in "visibility: read receivers" "visibility: trace" "visibility: upload" maps; do
    columns+=",camera_moving_${stage}_ms"
  done
  rows "$columns" | awk -F, '
    $2 == "timed" && $6 != "" {
      if (!($4 in seen)) { seen[$4] = 1; order[++count] = $4 }
      time[$4, $1] = $6 + $7 + $8 + $9
      maps[$4] += $5; read[$4] += $6; trace[$4] += $7; upload[$4] += $8; views[$4]++
      if ($4 == "raytraced") truth[$1] = time[$4, $1]
      all[$1] = 1
    }
    END {
      print "| | maps drawn | read back | decided and traced | uploaded | over `raytraced` |"
      print "|---|---|---|---|---|---|"
      for (k = 1; k <= count; ++k) {
        name = order[k]
        ratio = 0; n = 0
        for (view in all) if ((name, view) in time && truth[view] > 0) { ratio += time[name, view] / truth[view]; ++n }
        if (n > 0 && name !~ /nsm/)
          printf "| `%s` | %.1f ms | %.1f ms | %.1f ms | %.1f ms | %.2f |\n", name, maps[name] / views[name], read[name] / views[name], trace[name] / views[name], upload[name] / views[name], ratio / n
      }
    }'
}

# Columns of a motion: of drawing maps and from receivers to visibility.
stageColumns() {
  local stage columns=
  for stage in maps "visibility: estimate" "visibility: read receivers" "visibility: build" "visibility: trace" "visibility: upload"; do
    columns+=",$1_${stage}_ms"
  done
  echo "$columns"
}

# Per method and cell of a view: the time of drawing maps, where the light moves, and that from receivers to visibility.
# cells VIEW MOTION
cells() {
  rows "variant$(stageColumns "$2")" | awk -F, -v view="$1" -v motion="$2" -v cells="${timedCells[*]}" '
    $1 == view && $2 ~ /^timed-/ {
      sub(/timed-/, "", $2)
      if ($4 ~ /plain VTK|vtkShadowMapPass/) next
      if (!($4 in seen)) { seen[$4] = 1; order[++count] = $4 }
      time[$4, $2 "." $3] = (motion == "light_moving" ? sprintf("%.1f + ", $5) : "") sprintf("%.1f", $6 + $7 + $8 + $9 + $10)
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
    $2 ~ /^timed/ {
      for (i = 4; i <= 6; ++i) if ($i != "") {
        if (!count++ || $i < least) least = $i
        if ($i > most) most = $i
        within += $i >= 0.9
      }
    }
    END { if (count) printf "Stages make up %.3f to %.3f of a frame, and nine tenths or more in %d of %d cases.\n", least, most, within, count }'
}

# chainCases KIND : what became of the pixels of the contour, in the runs of that kind, into $out/KIND.csv: a row for each view, map and width, with the names of its columns in the first.
# L and S are the contour's pixels that are lit and in shadow by their texel, as those of hints are. Wrong pixels are those
# in the contour, which are all that are wrong less those that the chain without hints has, which is never wrong there.
chainCases() {
  local class columns="variant,wrong_pixels,false_light_pixels,false_shadow_pixels,traced_pixels,facing_pixels"
  for class in "hinted lit" "hinted in shadow" "confirmed by its texel" "confirmed by neighbours" "confirmed by adjacency" \
    corrected "traced lit by its texel" "traced in shadow by its texel"; do
    columns+=",class ${class}_pixels"
  done
  rows "$columns" | awk -F, -v kind="$1" '
    BEGIN {
      split("hintedL,hintedS,byTexel,byNeighbours,byAdjacency,corrected,leftL,leftS", classes, ",")
      stage["adjacency=off coherence=off leftovers=lit neighbours=1"] = "ST"
      stage["adjacency=off coherence=off leftovers=lit neighbours=4"] = "N4"
      stage["adjacency=off coherence=off leftovers=lit neighbours=9"] = "N9"
      stage["adjacency=edges coherence=off leftovers=lit neighbours=off"] = "A1"
      stage["adjacency=vertices coherence=off leftovers=lit neighbours=off"] = "A2"
      stage[""] = "TC4"; stage["coherence=9"] = "TC9"; stage["coherence=off"] = "sound"; stage["leftovers=lit"] = "lit"
    }
    $2 != kind { next }
    { sub(/ fit=once/, "", $4) }
    $4 == "nsm" { plain[$1, $3] = $5; next }
    $4 == "coherence" { rays[$1, $3] = $8; wrongOfRays[$1, $3] = $5; next }
    $4 ~ /^selective/ {
      settings = $4; width = $4; sub(/.*contour=/, "", width); sub(/ .*/, "", width)
      sub(/^selective ?/, "", settings); sub(/ ?contour=[246]/, "", settings); sub(/^ /, "", settings)
      of = $1 "," $3 "," width
      if (!(of in known)) { known[of] = 1; order[++count] = of }
      name = stage[settings]
      wrong[of, name] = $5; falseLight[of, name] = $6; falseShadow[of, name] = $7; traced[of, name] = $8; facing[of] = $9
      for (i = 1; i <= 8; ++i) class[of, name, classes[i]] = $(9 + i)
    }
    END {
      printf "view,map,width,facing,plain,rays,wrongOfRays,N,L,S,outside,traced,wrong,tracedSound,wrongLit"
      printf ",hintedL4,hintedS4,wrongL4,wrongS4,hintedL9,hintedS9,wrongL9,wrongS9,corrected,byN9,byA2,leftL,leftS"
      split("ST,N4,N9,A1,A2", alone, ",")
      for (i = 1; i <= 5; ++i) printf ",wrong%s,confirmed%s,corrected%s", alone[i], alone[i], alone[i]
      print ""
      for (k = 1; k <= count; ++k) {
        of = order[k]
        split(of, part, ",")
        outside = wrong[of, "sound"]; lightOutside = falseLight[of, "sound"]; shadowOutside = falseShadow[of, "sound"]
        byN9 = class[of, "TC4", "byTexel"] + class[of, "TC4", "byNeighbours"]
        lit = class[of, "TC4", "hintedL"] + class[of, "TC4", "corrected"] + class[of, "TC4", "leftL"]
        shadow = class[of, "TC4", "hintedS"] + byN9 + class[of, "TC4", "byAdjacency"] + class[of, "TC4", "leftS"]
        printf "%s,%d,%d,%d,%d,%d,%d,%d,%d,%d,%d,%d,%d", of, facing[of], plain[part[1], part[2]], rays[part[1], part[2]], \
          wrongOfRays[part[1], part[2]], lit + shadow, lit, shadow, outside, traced[of, "TC4"], wrong[of, "TC4"] - outside, \
          traced[of, "sound"], wrong[of, "lit"] - outside
        for (i = 4; i <= 9; i += 5) {
          name = "TC" i
          printf ",%d,%d,%d,%d", class[of, name, "hintedL"], class[of, name, "hintedS"], falseLight[of, name] - lightOutside, \
            falseShadow[of, name] - shadowOutside
        }
        printf ",%d,%d,%d,%d,%d", class[of, "TC4", "corrected"], byN9, class[of, "TC4", "byAdjacency"], \
          class[of, "TC4", "leftL"], class[of, "TC4", "leftS"]
        for (i = 1; i <= 5; ++i) {
          name = alone[i]
          printf ",%d,%d,%d", wrong[of, name] - outside, \
            class[of, name, "byTexel"] + class[of, name, "byNeighbours"] + class[of, name, "byAdjacency"], class[of, name, "corrected"]
        }
        print ""
      }
    }' > "$out/$1.csv"
}

# For awk: reads what chainCases wrote into value[case, name] and shares in per cent, as the thesis' tables have them; cases in order.
readCases='
  function share(of, name, part, whole) { value[of, name] = whole ? 100 * part / whole : 0 }
  FNR == 1 { for (i = 1; i <= NF; ++i) column[i] = $i; next }
  {
    c = ++caseCount
    for (i = 1; i <= NF; ++i) value[c, column[i]] = at[column[i]] = $i
    at["all"] = 1024 * 1024
    share(c, "contour %", at["N"], at["all"])
    share(c, "plain %", at["plain"], at["all"])
    share(c, "caught %", at["plain"] - at["outside"], at["plain"])
    share(c, "status %", at["plain"] - at["outside"], at["N"])
    for (texels = 4; texels <= 9; texels += 5) {
      hintedL = at["hintedL" texels]; hintedS = at["hintedS" texels]
      wrongHints = at["wrongL" texels] + at["wrongS" texels]
      share(c, "hinted" texels " %", hintedL + hintedS, at["N"])
      share(c, "hinted" texels "L %", hintedL, at["L"])
      share(c, "hinted" texels "S %", hintedS, at["S"])
      share(c, "wrong" texels " %", wrongHints, at["N"])
      share(c, "wrong" texels "L %", at["wrongL" texels], at["L"])
      share(c, "wrong" texels "S %", at["wrongS" texels], at["S"])
      share(c, "wrong of hints" texels " %", wrongHints, hintedL + hintedS)
      value[c, "hinted" texels] = hintedL + hintedS; value[c, "wrong" texels] = wrongHints
    }
    split("ST,N4,N9,A1,A2", alone, ",")
    for (i = 1; i <= 5; ++i) {
      share(c, alone[i] " %", at["wrong" alone[i]], at["N"])
      share(c, alone[i] " confirmed %", at["confirmed" alone[i]], at["S"])
      share(c, alone[i] " corrected %", at["corrected" alone[i]], at["L"])
    }
    share(c, "after N9 %", at["hintedL4"] + at["hintedS4"] + at["corrected"] + at["byN9"], at["N"])
    share(c, "after N9 L %", at["hintedL4"] + at["corrected"], at["L"])
    share(c, "after N9 S %", at["hintedS4"] + at["byN9"], at["S"])
    share(c, "after A2 %", at["hintedL4"] + at["hintedS4"] + at["corrected"] + at["byN9"] + at["byA2"], at["N"])
    share(c, "after A2 S %", at["hintedS4"] + at["byN9"] + at["byA2"], at["S"])
    share(c, "left %", at["leftL"] + at["leftS"], at["N"])
    share(c, "left L %", at["leftL"], at["L"])
    share(c, "left S %", at["leftS"], at["S"])
    share(c, "left of image %", at["leftL"] + at["leftS"], at["all"])
    share(c, "end %", at["wrong"], at["N"])
    share(c, "lit %", at["wrongLit"], at["N"])
  }'

# cases PROGRAM [KIND] : awk on the cases
cases() {
  awk -F, "$readCases $1" "$out/${2:-chain}.csv"
}

# Means over the 72 cases, the best and the worst of them, and what the thesis has, recomputed from its appendix.
chainMeans() {
  echo "| per cent of the contour, if not said otherwise | mean | best | worst | thesis: mean | thesis: least to most |"
  echo "|---|---|---|---|---|---|"
  # label; share; whether more is better; the thesis' mean; its least and most
  cases '
    function of(c) { return sprintf("%s %d, %d", value[c, "view"], value[c, "map"], value[c, "width"]) }
    END {
      count = split( \
        "contour, of the image (here least and most);contour %;;5.31;1.0 to 11.3\n" \
        "wrong pixels of the map that it catches, of all of them;caught %;more;92.41;57.42 to 100\n" \
        "its pixels whose status is wrong;status %;less;11.09;1.75 to 31.59\n" \
        "hinted by four texels;hinted4 %;more;58.30;2.39 to 91.06\n" \
        "... of those that are lit;hinted4L %;more;58.52;2.42 to 91.70\n" \
        "... of those in shadow;hinted4S %;more;57.96;2.37 to 90.15\n" \
        "... wrongly, of those that are lit;wrong4L %;less;0.55;0 to 2.94\n" \
        "... wrongly, of those in shadow;wrong4S %;less;0.12;0 to 0.51\n" \
        "hinted by nine texels;hinted9 %;more;43.36;0 to 81.69\n" \
        "... wrongly, of those that are lit;wrong9L %;less;0.28;0 to 1.32\n" \
        "... wrongly, of those in shadow;wrong9S %;less;0.02;0 to 0.10\n" \
        "its texel alone, the rest lit: wrong;ST %;less;12.06;3.11 to 24.78\n" \
        "... confirmed, of those in shadow;ST confirmed %;more;76.39;52.71 to 93.54\n" \
        "... corrected, of those that are lit;ST corrected %;more;0.09;0 to 0.59\n" \
        "four texels alone: wrong;N4 %;less;6.39;0.11 to 16.99\n" \
        "... confirmed, of those in shadow;N4 confirmed %;more;81.03;58.52 to 95.65\n" \
        "... corrected, of those that are lit;N4 corrected %;more;6.86;0.64 to 29.25\n" \
        "nine texels alone: wrong;N9 %;less;5.29;0.05 to 15.17\n" \
        "... confirmed, of those in shadow;N9 confirmed %;more;82.61;62.77 to 95.74\n" \
        "... corrected, of those that are lit;N9 corrected %;more;7.50;0.81 to 30.03\n" \
        "`edges` alone: wrong;A1 %;less;8.93;1.46 to 21.17\n" \
        "... confirmed, of those in shadow;A1 confirmed %;more;82.71;64.12 to 96.26\n" \
        "`vertices` alone: wrong;A2 %;less;7.19;0.84 to 18.25\n" \
        "... confirmed, of those in shadow;A2 confirmed %;more;86.19;67.92 to 97.76\n" \
        "the chain, settled after nine texels;after N9 %;more;75.04;49.09 to 94.27\n" \
        "... of those that are lit;after N9 L %;more;65.98;26.97 to 92.50\n" \
        "... of those in shadow;after N9 S %;more;84.13;63.03 to 96.77\n" \
        "the chain, settled after `vertices`;after A2 %;more;76.74;49.52 to 94.68\n" \
        "... of those in shadow;after A2 S %;more;87.63;68.07 to 97.78\n" \
        "left for rays;left %;less;23.26;5.32 to 50.48\n" \
        "... of those that are lit;left L %;less;34.02;7.50 to 73.03\n" \
        "... of those in shadow;left S %;less;12.37;2.22 to 31.93\n" \
        "left for rays, of the image;left of image %;less;1.13;0.16 to 2.98\n" \
        "wrong after the chain and its rays;end %;less;0.33;0 to 1.59\n" \
        "wrong if what is left is lit;lit %;less;2.95;0.02 to 11.25", line, "\n")
      for (i = 1; i <= count; ++i) {
        split(line[i], field, ";")
        sum = 0; low = high = 1
        for (c = 1; c <= caseCount; ++c) {
          x = value[c, field[2]]; sum += x
          if (x < value[low, field[2]]) low = c
          if (x > value[high, field[2]]) high = c
        }
        best = field[3] == "more" ? high : low; worst = field[3] == "more" ? low : high
        printf "| %s | %.2f | %.2f (%s) | %.2f (%s) | %s | %s |\n", field[1], sum / caseCount, value[best, field[2]], of(best), \
          value[worst, field[2]], of(worst), field[4], field[5]
      }
    }'
}

# groupMeans KEY COLUMNS THESIS [KIND] : means of columns over the cases of each group, the thesis' rows below them
# KEY is an awk expression of case c; THESIS has lines GROUP;CELL|CELL..., in the order in which groups are shown
groupMeans() {
  cases '
    END {
      columnCount = split("'"$2"'", names, ";"); lineCount = split("'"$3"'", line, "\n")
      for (c = 1; c <= caseCount; ++c) {
        group = '"$1"'; count[group]++
        for (i = 1; i <= columnCount; ++i) {
          x = value[c, names[i]]; key = group SUBSEP i
          sum[key] += x
          if (count[group] == 1 || x < low[key]) low[key] = x
          if (count[group] == 1 || x > high[key]) high[key] = x
        }
      }
      for (l = 1; l <= lineCount; ++l) {
        split(line[l], part, ";")
        group = part[1]
        if (!count[group]) continue
        printf "| %s", group
        for (i = 1; i <= columnCount; ++i) {
          printf " | %.2f", sum[group, i] / count[group]
          if (names[i] == "caught %") printf " [%.0f to %.0f]", low[group, i], high[group, i]
        }
        printf " |\n| thesis"
        cellCount = split(part[2], cell, "|")
        for (i = 1; i <= cellCount; ++i) printf " | *%s*", cell[i]
        print " |"
      }
    }' "${4:-chain}"
}

chainByMapAndWidth() {
  echo "| map, width | contour, of the image | caught | status wrong | hinted | wrong hints | alone: its texel | four texels | nine texels | \`edges\` | \`vertices\` | settled after nine | after \`vertices\` | left | wrong if lit |"
  echo "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|"
  groupMeans 'value[c, "map"] ", " value[c, "width"]' \
    "contour %;caught %;status %;hinted4 %;wrong4 %;ST %;N4 %;N9 %;A1 %;A2 %;after N9 %;after A2 %;left %;lit %" \
"1024, 2;2.96|76.6 [57 to 92]|19.14|40.73|0.52|16.77|9.03|7.66|13.88|11.89|63.63|65.94|34.06|4.91\\n\
1024, 4;5.39|92.8 [82 to 99]|12.65|51.73|0.39|13.47|7.59|6.38|10.28|8.38|70.60|72.66|27.34|3.71\\n\
1024, 6;7.51|96.3 [89 to 100]|9.35|60.94|0.34|11.72|6.61|5.51|8.40|6.59|76.29|78.03|21.97|2.95\\n\
2048, 2;3.03|92.7 [81 to 99]|12.72|51.75|0.28|12.43|6.16|5.03|9.41|7.68|71.86|73.69|26.31|2.84\\n\
2048, 4;5.43|97.6 [92 to 100]|7.35|68.09|0.25|9.56|4.80|3.86|6.38|4.81|81.46|82.78|17.22|1.87\\n\
2048, 6;7.54|98.5 [94 to 100]|5.30|76.55|0.22|8.39|4.16|3.31|5.25|3.77|86.38|87.37|12.63|1.43"
}

chainByScene() {
  echo "| scene, map | map's wrong pixels, of the image | contour, of the image | caught | status wrong | hinted | wrong, of hints | left |"
  echo "|---|---|---|---|---|---|---|---|"
  groupMeans 'substr(value[c, "view"], 1, index(value[c, "view"] "-", "-") - 1) ", " value[c, "map"]' \
    "plain %;contour %;caught %;status %;hinted4 %;wrong of hints4 %;left %" \
"primitives, 1024;0.25|2.1|88.8 [57 to 100]|11.4|60.1|0.02|24.0\\n\
primitives, 2048;0.13|2.1|97.9 [85 to 100]|7.0|70.6|0.02|16.6\\n\
bench, 1024;0.74|6.7|91.8 [75 to 99]|11.5|56.9|1.03|23.3\\n\
bench, 2048;0.42|6.8|97.6 [94 to 99]|7.0|70.2|0.36|15.5\\n\
trees, 1024;0.71|4.6|94.0 [79 to 99]|17.3|31.2|0.01|35.3\\n\
trees, 2048;0.36|4.6|98.4 [96 to 99]|9.7|56.8|0.00|22.2\\n\
flowers, 1024;1.32|7.7|79.7 [59 to 96]|14.7|56.3|2.05|28.5\\n\
flowers, 2048;0.80|7.9|91.2 [81 to 98]|10.2|64.2|1.21|20.7"
}

chainFitted() {
  echo "| map, width | map's wrong pixels, of the image | contour, of the image | caught | status wrong | hinted | wrong hints | settled after nine | after \`vertices\` | left |"
  echo "|---|---|---|---|---|---|---|---|---|---|"
  groupMeans 'value[c, "map"] ", " value[c, "width"]' \
    "plain %;contour %;caught %;status %;hinted4 %;wrong4 %;after N9 %;after A2 %;left %" \
"1024, 2;0.754|2.96|76.6 [57 to 92]|19.14|40.73|0.52|63.63|65.94|34.06\\n\
1024, 4;0.754|5.39|92.8 [82 to 99]|12.65|51.73|0.39|70.60|72.66|27.34\\n\
1024, 6;0.754|7.51|96.3 [89 to 100]|9.35|60.94|0.34|76.29|78.03|21.97\\n\
2048, 2;0.428|3.03|92.7 [81 to 99]|12.72|51.75|0.28|71.86|73.69|26.31\\n\
2048, 4;0.428|5.43|97.6 [92 to 100]|7.35|68.09|0.25|81.46|82.78|17.22\\n\
2048, 6;0.428|7.54|98.5 [94 to 100]|5.30|76.55|0.22|86.38|87.37|12.63" fitted
}

# What whole strategies cost and leave, pooled over the twelve views, in per cent of all pixels; in brackets the thesis.
strategies() {
  echo "| | map 1024: rays | wrong | map 2048: rays | wrong |"
  echo "|---|---|---|---|---|"
  cases '
    # row LABEL RAYS WRONG WIDTH THESIS: sums of names, with + between them
    function row(label, rays, wrong, width, thesis,   map, field, i) {
      split(thesis, field, " ")
      printf "| %s", label
      for (map = 1024; map <= 2048; map += 1024)
        printf " | %.3f (%s) | %.3f (%s)", total(rays, width, map), field[++i], total(wrong, width, map), field[++i]
      print " |"
    }
    function total(names, width, map,   name, count, c, i, sum, pixels) {
      count = split(names, name, "+")
      for (c = 1; c <= caseCount; ++c) if (value[c, "width"] == width && value[c, "map"] == map) {
        pixels += 1024 * 1024
        for (i = 1; i <= count; ++i) sum += value[c, name[i]]
      }
      return pixels ? 100 * sum / pixels : 0
    }
    END {
      row("the map alone (`nsm`)", "", "plain", 2, "0 0.754 0 0.428")
      row("`coherence`: rays wherever four texels do not agree", "rays", "wrongOfRays", 2, "3.177 0.056 1.821 0.029")
      split("2.96 0.199 3.03 0.043;5.39 0.069 5.43 0.016;7.51 0.038 7.54 0.010", whole, ";")
      split("0.99 0.221 0.78 0.055;1.46 0.099 0.94 0.035;1.65 0.072 0.97 0.033", chain, ";")
      split("1.62 0.199 1.59 0.043;2.93 0.069 2.83 0.016;4.04 0.038 3.90 0.010", sound, ";")
      split("0 0.373 0 0.151;0 0.307 0 0.143;0 0.299 0 0.143", lit, ";")
      for (w = 1; w <= 3; ++w) row("all of the contour of " 2 * w " traced", "N", "outside", 2 * w, whole[w])
      for (w = 1; w <= 3; ++w) row("`selective`, contour of " 2 * w, "traced", "outside+wrong", 2 * w, chain[w])
      for (w = 1; w <= 3; ++w) row("without hints, contour of " 2 * w, "tracedSound", "outside", 2 * w, sound[w])
      for (w = 1; w <= 3; ++w) row("what is left lit, contour of " 2 * w, "", "outside+wrongLit", 2 * w, lit[w])
    }'
}

# Wrong pixels of the map and of the chain, and what it traces, view by view.
chain() {
  echo "| view | map | \`nsm\`: wrong | 2 pixels: wrong, traced | 4 pixels | 6 pixels |"
  echo "|---|---|---|---|---|---|"
  cases '
    END {
      for (c = 1; c <= caseCount; ++c) {
        if (value[c, "width"] == 2) printf "| %s | %d | %d", value[c, "view"], value[c, "map"], value[c, "plain"]
        printf " | %d, %.2f %%", value[c, "outside"] + value[c, "wrong"], 100 * value[c, "traced"] / value[c, "facing"]
        if (value[c, "width"] == 6) print " |"
      }
    }'
}

# For awk, of a table with heading: check STATEMENT HOLDS WHERE counts the cases, and keeps those in which it does not hold; why[STATEMENT] and
# thesis[STATEMENT] say more; printChecks() writes the rows.
checks='
  BEGIN { print "| | holds in | thesis | not in |\n|---|---|---|---|" }
  function check(name, holds, where) {
    if (!(name in cases)) order[++statements] = name
    cases[name]++
    if (holds) held[name]++
    else { failures[name]++; not[name] = not[name] (not[name] ? "; " : "") where }
  }
  function printChecks(   i, name) {
    for (i = 1; i <= statements; ++i) {
      name = order[i]
      if (!held[name] && not[name] !~ /\(/) not[name] = "all of them"
      printf "| %s | %d of %d | %s | %s%s |\n", name, held[name], cases[name], thesis[name], not[name], \
        failures[name] && why[name] ? ". " why[name] : ""
    }
  }
  function place(view, picture, map) { return view " " picture (picture ? " " : "") map }
  function abs(x) { return x < 0 ? -x : x }'

# In how many cases what the theses' tables show is so here as well: Morais' tables of uncertain and wrong pixels.
pixelOrderings() {
  rows variant,wrong_pixels,traced_pixels,facing_pixels | awk -F, "$checks"'
    $2 ~ /^[0-9]+x[0-9]+$/ && $6 != "" {
      wrong[$1, $2, $3, $4] = $5; traced[$1, $2, $3, $4] = $6; facing[$1, $2] = $7
      run = $1 SUBSEP $2 SUBSEP $3
      if (!(run in known)) { known[run] = 1; runs[++runCount] = run }
      if (!($1 in seen)) { seen[$1] = 1; views[++viewCount] = $1 }
    }
    END {
      published = "crsm as_published=on"; publishedA = "crsma as_published=on"; fan = "crsma adjacency_ring=vertices"
      for (r = 1; r <= runCount; ++r) {
        run = runs[r]
        split(run, part, SUBSEP)
        where = place(part[1], part[2], part[3])
        check("`coherence` traces less than `crsma` as published", traced[run, "coherence"] < traced[run, publishedA], where)
        check("`crsma` as published traces no more than `crsm` as published", traced[run, publishedA] <= traced[run, published], where)
        check("`crsma` traces no more than `crsm`", traced[run, "crsma"] <= traced[run, "crsm"], where)
        check("`crsma` around vertices traces no more than across edges", traced[run, fan] <= traced[run, "crsma"], where)
        check("`silhouette` traces no more than `crsma`", traced[run, "silhouette"] <= traced[run, "crsma"], where)
        check("`crsm`, `crsma`, `silhouette`: no wrong pixel", wrong[run, "crsm"] + wrong[run, "crsma"] + wrong[run, fan] + wrong[run, "silhouette"] + wrong[run, "silhouette fit=once"] == 0, where)
        check("`coherence` has fewer wrong pixels than `nsm`", wrong[run, "coherence"] < wrong[run, "nsm"], where)
      }
      thesis["`coherence` traces less than `crsma` as published"] = thesis["`crsma` as published traces no more than `crsm` as published"] = "all"
      split("coherence;" published ";" publishedA ";crsm;crsma;" fan ";silhouette;silhouette fit=once", hybrids, ";")
      for (v = 1; v <= viewCount; ++v) for (i = 1; i in hybrids; ++i) {
        view = views[v]; name = hybrids[i]
        for (map = 1024; map <= 2048; map *= 2)
          check("traced pixels fall with the map\047s size, from 1024 on", traced[view, "1024x1024", 2 * map, name] < traced[view, "1024x1024", map, name], "`" name "` " place(view, "", 2 * map))
        points = 100 * abs(traced[view, "512x512", 1024, name] / facing[view, "512x512"] - traced[view, "1024x1024", 1024, name] / facing[view, "1024x1024"])
        check("the share of traced pixels is the same in 512 x 512 and 1024 x 1024 pixels, within 0.3 points", points <= 0.3, sprintf("`%s` %s (%.1f points)", name, view, points))
      }
      for (v = 1; v <= viewCount; ++v) for (map = 512; map <= 2048; map *= 2) {
        view = views[v]; of = view SUBSEP "1024x1024" SUBSEP map; twice = view SUBSEP "1024x1024" SUBSEP 2 * map
        check("`nsm` has fewer wrong pixels with a larger map", wrong[twice, "nsm"] < wrong[of, "nsm"], place(view, "", 2 * map))
        check("`crsm` as published has more wrong pixels with a larger map", wrong[twice, published] >= wrong[of, published], place(view, "", 2 * map))
        check("`crsma` as published has more wrong pixels with a larger map", wrong[twice, publishedA] >= wrong[of, publishedA], place(view, "", 2 * map))
      }
      printChecks()
    }'
}

# Morais' tables of times: of drawing maps (light moving), from receivers to visibility (camera moving), and both (light moving).
timeOrderings() {
  rows "variant$(stageColumns light_moving)$(stageColumns camera_moving)" | awk -F, "$checks"'
    $2 ~ /^timed/ && $4 !~ /plain VTK|vtkShadowMapPass/ && $13 != "" {
      run = $1 SUBSEP $2 SUBSEP $3
      if (!(run in known)) { known[run] = 1; runs[++runCount] = run }
      maps[run, $4] = $5; whole[run, $4] = $5 + $6 + $7 + $8 + $9 + $10; resolve[run, $4] = $12 + $13 + $14 + $15 + $16
      if (!($4 in seen) && $4 !~ /nsm|raytraced/) { seen[$4] = 1; methods[++methodCount] = $4 }
    }
    function faster(name, times, one, other) { check(name, times[run, one] < times[run, other], where) }
    # count(KEY, HOLDS) : for the table of methods
    function count(key, holds) { of[key]++; yes[key] += holds }
    function counted(key) { return of[key] ? yes[key] " of " of[key] : "" }
    END {
      if (!runCount) exit
      published = "crsm as_published=on"; publishedA = "crsma as_published=on"
      drawn[1] = "maps: `coherence` draws its own faster than `crsm` as published"
      drawn[2] = "maps: `crsm` as published draws them faster than `crsma` as published"
      drawn[3] = "maps: `crsm` as published draws them faster than `crsm`"
      drawn[4] = "maps: `crsm` draws them faster than `crsma`"
      cheapest = "maps and resolve: `coherence` takes less than `crsm` and `crsma` as published"
      adjacent = "maps and resolve: `crsma` as published takes less than `crsm` as published"
      for (r = 1; r <= runCount; ++r) {
        run = runs[r]
        split(run, part, SUBSEP)
        where = place(part[1], substr(part[2], 7), part[3])
        if (part[2] != "timed") {
          faster(drawn[1], maps, "coherence", published)
          faster(drawn[2], maps, published, publishedA)
          faster(drawn[3], maps, published, "crsm")
          faster(drawn[4], maps, "crsm", "crsma")
          check(cheapest, whole[run, "coherence"] < whole[run, published] && whole[run, "coherence"] < whole[run, publishedA], where)
          faster(adjacent, whole, publishedA, published)
        }
        for (m = 1; m <= methodCount; ++m) if ((run, methods[m]) in whole) {
          name = methods[m]
          if (part[2] == "timed") { count(name " views", resolve[run, name] < resolve[run, "raytraced"]); continue }
          count(name " moving", whole[run, name] < whole[run, "raytraced"])
          count(name " static", resolve[run, name] < resolve[run, "raytraced"])
          half = part[1] SUBSEP part[2] SUBSEP part[3] / 2
          if (part[2] == "timed-1024x1024" && part[3] > 1024) count(name " falls", resolve[run, name] < resolve[half, name])
        }
      }
      thesis[drawn[1]] = thesis[drawn[2]] = "16 of 16"; thesis[cheapest] = "48 of 48"; thesis[adjacent] = "23 of 48"
      why[drawn[1]] = why[cheapest] = "Its map, of triangles, is drawn on the CPU in double precision and has 24 bytes a texel; the thesis had a plain map of depths, and a GPU that looks it up"
      why[drawn[2]] = why[adjacent] = "Both are drawn on the CPU here, of the same triangles; in the thesis it is a geometry shader that makes maps with neighbours slow"
      printChecks()
      print ""
      print "How often each takes less than `raytraced`, and less with twice the map, from 1024 on (the thesis in brackets):"
      print ""
      print "| | maps and resolve, light moving | resolve, light static | the same, ten views, map 1024 | resolve, twice the map |"
      print "|---|---|---|---|---|"
      moving["coherence"] = " (42 of 48)"; moving[published] = moving[publishedA] = " (20 of 48)"
      twice["coherence"] = " (23 of 24)"; twice[published] = twice[publishedA] = " (24 of 24)"
      for (m = 1; m <= methodCount; ++m) {
        name = methods[m]
        printf "| `%s` | %s%s | %s | %s | %s%s |\n", name, counted(name " moving"), of[name " moving"] ? moving[name] : "", counted(name " static"), \
          counted(name " views"), counted(name " falls"), of[name " falls"] ? twice[name] : ""
      }
      print ""
      print "Where they take longer: maps drawn on the CPU take longer than the rays that they save, so that they pay where the light rests; where"
      print "most pixels are traced (`crsm`, small maps), looking them up comes on top of their rays. `coherence` and `selective` look"
      print "every pixel up, on the CPU, too, where a look-up with its triangle takes longer than a ray of Embree"
      print "([limits](techniques/selective.md#artefacts-and-limits)): a larger map has fewer rays, but not fewer look-ups. In the thesis both were the GPU\047s."
    }'
}

# Moderno's tables of the chain and its stages
chainOrderings() {
  cases "$checks"'
    function get(name) { return value[c, name] }
    # with(NAME, MAP, WIDTH) : the value of the same view
    function with(name, map, width) { return value[index_[get("view"), map, width], name] }
    function of3(name, map) { split(with(name, map, 2) " " with(name, map, 4) " " with(name, map, 6), three, " ") }
    function rising() { return three[1] + 0 < three[2] + 0 && three[2] + 0 < three[3] + 0 }
    function falling() { return three[1] + 0 > three[2] + 0 && three[2] + 0 > three[3] + 0 }
    function values(format) { return sprintf("(" format ", " format ", " format ")", three[1], three[2], three[3]) }
    END {
      for (c = 1; c <= caseCount; ++c) index_[get("view"), get("map"), get("width")] = c
      for (c = 1; c <= caseCount; ++c) {
        view = get("view"); map = get("map"); width = get("width")
        if (!((view, 1024, 6) in index_) || !((view, 2048, 6) in index_)) continue
        # Of views
        if (map == 1024 && width == 2) {
          ratio = with("plain", 2048, 2) / with("plain", 1024, 2)
          check(s1 = "`nsm`: twice the map (2048 for 1024) leaves 0.49 to 0.61 of its wrong pixels", ratio >= 0.485 && ratio < 0.615, sprintf("%s (%.2f of %d)", view, ratio, with("plain", 1024, 2)))
          thesis[s1] = "12 of 12"
        }
        if (map == 2048 && width == 4) {
          check(s2 = "the contour of 4 pixels has nine tenths of the wrong pixels, where the map has twice the picture\047s size", get("caught %") >= 90, sprintf("%s (%.1f %%, that of 6 %.1f %%)", view, get("caught %"), with("caught %", 2048, 6)))
          thesis[s2] = "12 of 12"
        }
        # Of views and maps
        if (width == 2) {
          where = view " " map
          if (view ~ /^(primitives|trees)/) {
            N4 = with("N", map, 4) / with("N", map, 2); N6 = with("N", map, 6) / with("N", map, 2)
            check(s3 = "long edges (primitives, trees): contours of 4 and 6 pixels have 1.95 to 1.98 and 2.88 to 2.95 times the pixels of that of 2", \
              N4 >= 1.945 && N4 < 1.985 && N6 >= 2.875 && N6 < 2.955, sprintf("%s (%.2f, %.2f of %.1f %%)", where, N4, N6, with("contour %", map, 2)))
            thesis[s3] = "12 of 12"
          }
          of3("left", map)
          for (i = 1; i <= 3; ++i) three[i] = with("leftL", map, 2 * i) + with("leftS", map, 2 * i)
          check(s4 = "a wider contour: more pixels are left", rising(), where " " values("%d"))
          of3("left %", map); check(s5 = "a wider contour: a smaller share of it is left", falling(), where " " values("%.1f %%"))
          of3("hinted4 %", map); check(s6 = "a wider contour: a larger share of it is hinted", rising(), where " " values("%.1f %%"))
          of3("caught %", map); check(s7 = "a wider contour: no smaller share of the wrong pixels is in it", three[1] + 0 <= three[2] + 0 && three[2] + 0 <= three[3] + 0, where " " values("%.1f %%"))
          of3("status %", map); check(s8 = "a wider contour: a smaller share of it is wrong by its status", falling(), where " " values("%.1f %%"))
          for (i = 1; i <= 3; ++i) three[i] = with("outside", map, 2 * i) + with("wrong", map, 2 * i)
          check(s9 = "a wider contour: no more wrong pixels in the picture", three[1] >= three[2] && three[2] >= three[3], where " " values("%d"))
          thesis[s4] = thesis[s5] = thesis[s7] = thesis[s8] = "24 of 24"; thesis[s6] = "23 of 24"
          rest = (with("outside", map, 4) + with("wrong", map, 4)) / with("plain", map, 4)
          check(s10 = "contour of 4: at most a tenth of the map\047s wrong pixels is left, with those of wrong hints", rest <= 0.1, sprintf("%s (%.2f)", where, rest))
          if (rest > 0.1) { restOutside += with("outside", map, 4); restHints += with("wrong", map, 4) }
        }
        # Of views and widths
        if (map == 1024) {
          where = view ", contour " width
          check(s11 = "twice the map: a larger share of the contour is hinted", with("hinted4 %", 2048, width) > with("hinted4 %", 1024, width), where)
          check(s12 = "twice the map: a smaller share of the contour is left", with("left %", 2048, width) < with("left %", 1024, width), where)
          thesis[s11] = thesis[s12] = "36 of 36"
        }
        # Of all cases
        where = view " " map ", contour " width
        check(s13 = "more pixels are left that are lit by their texel than in shadow", get("leftL") > get("leftS"), where)
        check(s14 = "a larger share is left of those that are lit by their texel than of those in shadow", get("left L %") > get("left S %"), where)
        check(s15 = "hints of nine texels are no more than those of four, and no more of them are wrong", \
          get("hinted9") <= get("hinted4") && get("wrong9") <= get("wrong4"), where)
        ratio = get("wrongLit") / (get("plain") - get("outside"))
        check(s16 = "the whole chain, the rest lit: at most 0.61 of the wrong pixels that `nsm` has in the contour", ratio <= 0.61, sprintf("%s (%.2f)", where, ratio))
        check(s17 = "one stage, the rest lit: nine texels leave no more wrong pixels than four, four no more than one", get("wrongN9") <= get("wrongN4") && get("wrongN4") <= get("wrongST"), where)
        check(s18 = "one stage, the rest lit: `vertices` leaves no more wrong pixels than `edges`, `edges` no more than its texel alone", get("wrongA2") <= get("wrongA1") && get("wrongA1") <= get("wrongST"), where)
        check(s19 = "one stage, the rest lit: `vertices` confirms more pixels than nine texels", get("confirmedA2") > get("confirmedN9"), sprintf("%s (%d, %d)", where, get("confirmedA2"), get("confirmedN9")))
        check(s20 = "one stage, the rest lit: nine texels leave fewer wrong pixels than `vertices`", get("wrongN9") < get("wrongA2"), sprintf("%s (%d, %d)", where, get("confirmedA2") - get("confirmedN9"), get("correctedN9") - get("correctedA2")))
        thesis[s13] = thesis[s14] = thesis[s15] = thesis[s16] = thesis[s17] = thesis[s18] = "72 of 72"; thesis[s19] = "68 of 72"; thesis[s20] = "52 of 72"
        if (view ~ /^primitives/)  {
          check(s21 = "primitives: the contour is 1 to 3.5 % of the picture", get("contour %") >= 0.95 && get("contour %") <= 3.5, sprintf("%s (%.2f %%)", where, get("contour %")))
          thesis[s21] = "18 of 18"
          if (width == 2) check(s22 = "primitives: 0.05 to 0.45 % of the picture are the map\047s wrong pixels", get("plain %") >= 0.045 && get("plain %") < 0.455, sprintf("%s %d (%.3f %%)", view, map, get("plain %")))
          thesis[s22] = "6 of 6"
        }
        allLit += get("leftL"); allShadow += get("leftS")
      }
      why[s1] = "A few long straight edges are all there is, and how wrong each is depends on where it falls in its texels: for other sizes, 850 to 1200 and twice as many, 0.40 to 0.59 (against), 0.36 to 0.59 (with) and 0.44 to 0.60"
      why[s2] = "Leaves and petals are finer than texels there: of what the map has not seen it shows no edge. A wider contour reaches more of it, and fitted maps see more: their table above"
      why[s3] = "In brackets the ratios, and what the contour of 2 is of the picture, in the thesis 2.0 to 2.6 % (trees). Edges that lie closer together than the contours are wide share them: the shadows of single leaves, where the thesis has large triangles. Of the primitives, pixels that are turned away from the light are missing: with them, as in the thesis, the ratios are 1.97 and 2.92 in all three views (of the pictures of classes, map of 2048)"
      why[s4] = "Where edges are smooth, what four texels do not agree about lies within a texel of them, and all of it is in the narrower contours already"
      why[s6] = "It hardly changes with the width there, as in the thesis\047 own exception, of the flowers as well: most of what is hinted in the narrowest contour lies where a petal ends in the picture or turns away from the light, about which texels agree; wider contours reach the edges of shadows"
      if (restOutside + restHints > 0) why[s10] = sprintf("Of what is left in these %.0f %% are outside of the contour: what is finer than texels and has no edge in the map; the rest are wrong hints", 100 * restOutside / (restOutside + restHints))
      why[s19] = "In brackets both. Nine texels see several of the leaves that shade a pixel, whose triangles do not touch; the thesis has its four exceptions in the trees, too"
      why[s20] = "In brackets by how much more `vertices` confirms than nine texels, and how much more these correct: what is wrong is what is neither. The thesis has 15 of its 18 cases of the primitives and 5 of those of the flowers so"
      why[s21] = "Sizes and places of the solids are not in the thesis: ours cast shadows with shorter edges"
      why[s22] = why[s21] ", along which fewer pixels are wrong"
      printChecks()
      printf "\nPixels that `selective` leaves: %.2f that are lit by their texel to 1 in shadow (thesis: 2.8).\n", allShadow ? allLit / allShadow : 0
    }'
}

page() {
  echo "# Sweeps over maps, pictures and views"
  echo
  echo "Written by \`docs/sweeps.sh\`, on: $(machine)."
  echo
  echo "Ten views: the garden's nine sides and the atrium, as in Morais' thesis. Twelve views: the garden's and the three sides of"
  echo "the primitives, as in Moderno's. Traced is the share of the pixels that face the light; wrong pixels are in pixels."
  echo "Means come first, then [what the theses' tables show](#what-the-theses-tables-show-here), then tables"
  echo "[view by view](#view-by-view)."
  echo
  echo "## Means over ten views"
  for size in 512x512 1024x1024 1920x1080; do
    echo
    echo "### ${size/x/ x } pixels"
    echo
    uncertain "$size"
  done
  echo
  echo "Morais' means, 1024 x 1024 pixels, map of 1024: \`coherence\` 20.0 %, \`crsm\` as published 51.7 %, \`crsma\` as published 36.7 %."
  echo
  echo "### Time, 1024 x 1024 pixels, maps of 1024"
  echo
  echo "Medians of $viewFrames frames. Maps are drawn in every frame while the light moves (\`bake\` \`always\`); the other columns are of a"
  echo "camera that moves under a light that does not, for which they are drawn once."
  echo
  times
  echo
  stageShares
  echo
  echo "## The selective chain: means over 72 cases"
  echo
  echo "Twelve views, maps of 1024 and 2048, contours of 2, 4 and 6 pixels; 1024 x 1024 pixels. Wrong hints, and what is wrong in the"
  echo "contour after a stage, are told by the chain without hints, which has no wrong pixel there. The wrong pixels of the map"
  echo "are those of \`nsm\`: of the chain's own status in the contour alone no report tells them, only"
  echo "[tests](techniques/acceptance.md#the-stages-of-the-chain), by which they are less than one per cent apart on bench-side and a tenth on the"
  echo "primitives (maps of 2048). Pixels that are turned away from the light are not counted in contours; in the thesis they are, as hinted."
  echo "\`edges\` and \`vertices\` correct nothing: they are asked for pixels in shadow alone."
  echo
  chainMeans
  echo
  echo "By map and width of the contour, per cent of the contour, means over twelve views [least to most]; below each row the thesis' one:"
  echo
  chainByMapAndWidth
  echo
  echo "The maps above lie over all casters. The thesis fits them to what the camera sees; the same with \`fit\` \`once\`:"
  echo
  chainFitted
  echo
  echo "By scene and map (over all casters), means over three views and three widths:"
  echo
  chainByScene
  echo
  echo "What whole strategies trace and leave wrong, per cent of all pixels of the twelve views (the thesis in brackets):"
  echo
  strategies
  echo
  echo "## What the theses' tables show, here"
  echo
  echo "Cases are views, pictures and maps; those in which a statement does not hold are named, with the reason. The thesis' column says"
  echo "in how many of its own cases it holds, where its tables tell."
  echo
  echo "### Traced and wrong pixels (Morais)"
  echo
  pixelOrderings
  echo
  echo "### Times (Morais)"
  echo
  echo "Of the [two views](#time-over-maps-and-pictures) that are timed over maps and pictures. Resolve is from receivers to visibility."
  echo
  timeOrderings
  echo
  echo "### The selective chain (Moderno)"
  echo
  chainOrderings
  echo
  echo "## View by view"
  echo
  echo "### Traced and wrong, 1024 x 1024 pixels, maps of 1024"
  echo
  echo "Per cent of the pixels that face the light, then wrong pixels where there are any; of \`nsm\` the wrong pixels."
  echo
  uncertainByView 1024x1024 1024
  echo
  echo "### Time over maps and pictures"
  echo
  echo "In milliseconds, medians of $cellFrames frames. \`nsm\` looks up on the (software) GPU. While the light moves: maps drawn + from receivers to"
  echo "visibility, with \`bake\` \`always\`, by which \`crsm\` and its kin draw their maps in these frames, too. While the camera moves and the light"
  echo "does not: from receivers to visibility alone. Of two of the ten views, one of the garden and the atrium: a machine must do nothing else while"
  echo "these are timed, and all ten would take five times as long."
  for view in "${timedViews[@]}"; do
    for motion in light camera; do
      echo
      echo "#### $view, $motion moving"
      echo
      cells "$view" "${motion}_moving"
    done
  done
  echo
  echo "### The selective chain"
  echo
  echo "Wrong pixels of the map and of the chain (default settings), and the share of the pixels that face the light that it traces."
  echo
  chain
}

chainCases chain
chainCases fitted
page > "$out/page.md"
if [ "${1:-}" != counts ]; then
  mv "$out/page.md" docs/sweeps.md
fi
