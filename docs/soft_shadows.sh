#!/bin/bash
# Measures the error of soft shadows against the time that they take, and writes docs/soft_shadows.md, with pictures in docs/figures/soft. Takes 25 minutes or so;
# what the same program has measured in the same way before, in out/soft, is not measured again.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source docs/comparisons.sh
prepare

out=out/soft
mkdir -p "$out"

techniques=nsm,planar:planes=64,pcss:pcss_samples=low,pcss,pcss:pcss_samples=high
for rays in 1 2 3 4 8 16; do
  techniques+=",montecarlo:mc_rays=$rays"
done
techniques+=,montecarlo:mc_filter=0,montecarlo:mc_layers=near_far
for samples in 4 16 64 256; do
  techniques+=",sampled:light_samples=$samples,coherence:light_samples=$samples"
  techniques+=",penumbra:light_samples=$samples,raytraced:light_samples=$samples"
done
for sampling in jittered random; do
  for samples in 4 16 64 256; do
    techniques+=",raytraced:light_sampling=$sampling:light_samples=$samples"
  done
done

# What penumbra has time for where raytraced takes 256.
techniques+=,penumbra:light_samples=1024

# measure NAME SCENE OPTION... : into $out/NAME
measure() {
  compareOnce "$out/$1" "$2" --route image --size 256x256 "${@:3}"
}

# compare SCENE OPTION... : all techniques
compare() {
  measure "$1" "$1" --techniques "$techniques" --frames 5 "${@:2}"
}

# compareTruths SCENE OPTION... : the truth against a second truth, which is its own error; nobody asks for times
compareTruths() {
  measure "$1.truth" "$1" --techniques raytraced:light_samples=4096 --frames 0 "${@:2}"
}

# Scenes with lamps whose sides are a tenth of the scene, and scenes whose sun gets that size, about.
scenes=(soft-stack soft-panels soft-plates soft-long-cube)
sunny=(bunny atrium)
degrees=5
for command in compare compareTruths; do
  for scene in "${scenes[@]}"; do
    "$command" "$scene"
  done
  for scene in "${sunny[@]}"; do
    "$command" "$scene" --light-radius "$degrees"
  done
done

# Curtis' simplest form, which has no inner penumbrae: for its picture.
measure soft-stack.near soft-stack --techniques montecarlo:mc_layers=near --frames 0

# Of these variants' pictures, the names that the comparison gives them, what they are here, and what is written above them.
shown=(raytraced-light_samples-256 pcss-1024-image montecarlo-mc_rays-3-1024 sampled-light_samples-256-1024 penumbra-light_samples-64)
names=(raytraced pcss montecarlo sampled penumbra)
titles=('`raytraced`, 256 rays' '`pcss`' '`montecarlo`, 9 rays' '`sampled`, 256 points' '`penumbra`, 64 points')

# One scene's pictures: puts them into docs/figures/soft, and writes a table of them.
pictures() {
  local titleRow="|" line="|" row="|"
  mkdir -p docs/figures/soft
  for k in "${!shown[@]}"; do
    cp "$out/$1/${shown[$k]}.png" "docs/figures/soft/$1-${names[$k]}.png"
    titleRow+=" ${titles[$k]} |"
    line+="---|"
    row+=" ![$1 by ${names[$k]}](figures/soft/$1-${names[$k]}.png) |"
  done
  printf '%s\n' "$titleRow" "$line" "$row"
}

# One scene's variants: error, time, and the error of raytraced at that time, between its two numbers of samples around it.
table() {
  results "$out/$1" | awk -F, '
    NR == 1 { for (i = NF; i >= 1; --i) column[$i] = i; next }
    {
      name = $1; sub(/ 1024/, "", name); sub(/ image$/, "", name)
      if (name ~ /VTK|vtkShadowMapPass/) next
      order[++count] = name
      mae[name] = $(column["mean_absolute_error"]); rms[name] = $(column["rms_error"]); ms[name] = $(column["camera_moving_ms"])
      if (name ~ /^raytraced light_samples=[0-9]+$/) truth[++truths] = name
    }
    END {
      print "| | MAE | RMS | ms | RMS of `raytraced` in that time |"
      print "|---|---|---|---|---|"
      for (k = 1; k <= count; ++k) {
        name = order[k]; other = ""
        for (i = 1; i < truths; ++i) {
          a = truth[i]; b = truth[i + 1]
          if (ms[a] <= ms[name] && ms[name] <= ms[b] && ms[a] < ms[b])
            other = sprintf("%.4f", exp(log(rms[a]) + (log(rms[b]) - log(rms[a])) * (log(ms[name]) - log(ms[a])) / (log(ms[b]) - log(ms[a]))))
        }
        if (truths && ms[name] < ms[truth[1]]) other = "none: less than with 4"
        if (truths && ms[name] > ms[truth[truths]]) other = "less: more than with 256"
        if (name ~ /^raytraced/) other = ""
        printf "| `%s` | %.5f | %.4f | %.0f | %s |\n", name, mae[name], rms[name], ms[name], other
      }
    }'
}

# What montecarlo makes of the first surface alone.
nearLayer() {
  local mae
  mae="$(results "$out/soft-stack.near" | awk -F, '
    NR == 1 { for (i = NF; i >= 1; --i) column[$i] = i; next }
    $1 ~ /^montecarlo/ { printf "%.4f", $(column["mean_absolute_error"]) }')"
  [ -n "$mae" ]
  cp "$out/soft-stack.near/montecarlo-mc_layers-near-1024.png" docs/figures/soft/soft-stack-near.png
  echo "With the first surface alone (\`mc_layers\` \`near\`), all behind which is solid, there are no inner penumbrae: MAE $mae. The"
  echo "ground casts in this scene, so that two layers (\`near_far\`) have none there, either:"
  echo
  echo "![soft-stack by its first surface alone](figures/soft/soft-stack-near.png)"
}

# One scene: its two truths.
truths() {
  results "$out/$1.truth" | awk -F, -v scene="$1" '
    NR == 1 { for (i = NF; i >= 1; --i) column[$i] = i; next }
    $1 ~ /light_samples=4096/ { printf "| %s | %.5f | %.4f |\n", scene, $(column["mean_absolute_error"]), $(column["rms_error"]) }'
}

# One scene: the RMS error of raytraced, and the least one of the others that take no longer.
equalTimes() {
  results "$out/$1" | awk -F, -v scene="$1" '
    NR == 1 { for (i = NF; i >= 1; --i) column[$i] = i; next }
    {
      name = $1; sub(/ 1024/, "", name); sub(/ image$/, "", name)
      if (name ~ /VTK|vtkShadowMapPass/) next
      rms = $(column["rms_error"]); ms = $(column["camera_moving_ms"])
      if (name !~ /^raytraced/) { other[++others] = name; rmsOf[name] = rms; msOf[name] = ms }
      if (name ~ /^raytraced light_samples=[0-9]+$/) { truth[++truths] = rms; truthMs[truths] = ms }
    }
    END {
      printf "| %s", scene
      for (i = 1; i <= truths; ++i) {
        best = ""
        for (k = 1; k <= others; ++k)
          if (msOf[other[k]] <= truthMs[i] && (best == "" || rmsOf[other[k]] < rmsOf[best])) best = other[k]
        if (best == "") printf " | %.4f; none is as fast", truth[i]
        else printf " | %.4f; %.4f `%s`", truth[i], rmsOf[best], best
      }
      print " |"
    }'
}

{
  echo "# Soft shadows: error against time"
  echo
  echo "Written by \`docs/soft_shadows.sh\`, on: $(machine). Errors are those of visibility against \`raytraced\`"
  echo "with 4,096 other samples, over the pixels that face the light; times are those of whole frames with a moving camera, 256 x 256 pixels, maps of"
  echo "1024, median of 5, all techniques taking turns. What a technique is and lacks: [soft](techniques/soft.md), [montecarlo](techniques/montecarlo.md), [penumbra](techniques/penumbra.md)."
  echo
  echo "## The truth"
  echo
  echo "4,096 samples against 4,096 others:"
  echo
  echo "| | MAE | RMS |"
  echo "|---|---|---|"
  for scene in "${scenes[@]}" "${sunny[@]}"; do
    truths "$scene"
  done
  echo
  echo "## In the same time"
  echo
  echo "The RMS error of \`raytraced\` with so many samples; the least one of all others that take no longer:"
  echo
  echo "| | 4 samples | 16 samples | 64 samples | 256 samples |"
  echo "|---|---|---|---|---|"
  for scene in "${scenes[@]}" "${sunny[@]}"; do
    equalTimes "$scene"
  done
  for scene in "${scenes[@]}"; do
    echo
    echo "## $scene"
    echo
    pictures "$scene"
    echo
    table "$scene"
    if [ "$scene" = soft-stack ]; then
      echo
      nearLayer
    fi
  done
  for scene in "${sunny[@]}"; do
    echo
    echo "## $scene, a sun of $degrees degrees"
    echo
    pictures "$scene"
    echo
    table "$scene"
  done
} > "$out/page.md"
mv "$out/page.md" docs/soft_shadows.md
