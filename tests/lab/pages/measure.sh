#!/bin/bash
# Measure what the tables of docs/results hold, and make the pages again.
#
#   tests/lab/pages/measure.sh NAME [ARGUMENT...]
#
# NAME is a function of this script that takes no other's part:
#   bunny           all techniques on the bunny
#   picture         the picture of README.md
#   exact_price     exact shadows of four scenes
#   study           what accuracy costs: ten scenes; continues where it was interrupted
#   conclusions     the publications' conclusions; a quarter of an hour
#   auto            how well `auto` chooses: 200 random places in each of 31 scenes, and flights
#   growth          times over triangles, props, programs, lights, pixels
#   hard_cases      the literature's hard cases by all techniques
#   split_rays      100 million rays against split scenes
#   drag_rate       drags at 15 frames a second
#   one_drawing     the drawings that exact shadows of several suns take
#   gpu [PROGRAMS]  on a machine with a GPU; PROGRAMS is a folder with gnomon and its benchmarks
#   vtk_programs FOLDER DATA        VTK's tests in C++, each with tests/lab/vtk_programs/main.cxx
#   vtk_motion FOLDER DATA          ten of them with a moving camera
#   vtk_python_programs VTK         VTK's tests in Python, of a checkout of v9.1.0
#   vtk_releases BUILD RELEASE...   visibility by VTK of other Debian releases (tests/vtk/run.sh)
#
# Raw results are in out/. Comparisons by the same program with the same options are not repeated.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../../.."
here=tests/lab/pages
source cmake/debian.sh
programs=build/lab/bin

# prepare TARGET... : installs packages, and builds `gnomon` and these targets in build/lab
prepare()
{
  install_packages libvtk9-qt-dev python3-jinja2 python3-matplotlib
  mkdir -p build out
  cmake --preset lab > build/configure.log
  cmake --build --preset lab --target gnomon "$@"
}

# put NAME TABLE... : writes what was measured on, and the pages
put()
{
  local results machine
  machine="$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1), $(nproc) processors; "
  machine+="${opengl:-OpenGL by software (llvmpipe)}"
  for results in "$@"; do
    $here/collect.py machine "$results" "$machine"
  done
  /usr/bin/python3 $here/pages.py --charts
}

# compareOnce FOLDER SCENE OPTION... : `gnomon compare` into the folder
compareOnce()
{
  local folder="$1" how
  how="${*:2} $(cat $programs/gnomon $programs/../lib/libGnomon*.so | cksum)"
  if [ "$(cat "$folder/how.txt" 2> /dev/null)" = "$how" ]; then
    return
  fi
  rm -rf "$folder" "$folder.part"
  $programs/gnomon compare "$2" -o "$folder.part" "${@:3}"
  echo "$how" > "$folder.part/how.txt"
  mv "$folder.part" "$folder"
}

# compareInto EXPERIMENT SHADOWS SCENE OPTION... : `gnomon compare` into a table
compareInto()
{
  compareOnce "out/$1/$3.$2" "${@:3}"
  $here/collect.py comparisons "$1" "$3" "$2" "out/$1/$3.$2"
}

bunny()
{
  local name hard=nsm,pcf,esm,vsm,evsm,msm,adaptive,lispsm,tsm,pssm,planar,coherence,selective
  prepare
  compareInto bunny hard bunny --techniques "$hard,crsm,crsma,silhouette,raytraced" \
    --route inline --frames 31
  compareInto bunny default bunny --techniques auto --frames 31
  compareInto bunny soft bunny --techniques pcss,montecarlo,sampled,penumbra,raytraced \
    --route image --frames 11 --light-radius 5
  for name in plain-VTK vtkShadowMapPass-1024 nsm-1024-inline raytraced; do
    cp "out/bunny/bunny.hard/$name.png" docs/figures/
  done
  for name in pcss-1024-image montecarlo-1024 penumbra; do
    cp "out/bunny/bunny.soft/$name.png" "docs/figures/${name%%-*}.png"
  done
  put bunny
}

picture()
{
  local out=out/picture
  prepare
  compareOnce $out bunny --techniques raytraced --frames 0 --size 640x640 --truth-samples 1
  $programs/gnomon render bunny -o $out/gnomon.png --size 640x640 --sky 0.3
  /usr/bin/python3 $here/side_by_side.py docs/figures/first.png \
    "plain VTK: no shadows=$out/plain-VTK.png" \
    "VTK's own: vtkShadowMapPass=$out/vtkShadowMapPass-1024.png" \
    "Gnomon: a sun and a sky=$out/gnomon.png"
}

exactPrices()
{
  local scene
  for scene in bunny terrain atrium city; do
    compareInto "$1" hard "$scene" --techniques nsm,silhouette,raytraced --route inline --frames 15
  done
}

exact_price()
{
  prepare
  exactPrices "exact price"
  put "exact price"
}

study()
{
  local program
  prepare
  program=$(cat $programs/gnomon $programs/../lib/libGnomon*.so | cksum)
  if [ "$(cat out/study/program.txt 2> /dev/null)" != "$program" ]; then
    rm -rf out/study
    mkdir -p out/study
    echo "$program" > out/study/program.txt
  fi
  $programs/gnomon study -o out/study --views 1 --size 512x512 --map-sizes 1024 --frames 7 \
    --truth-samples 1024
  tr -d '\r' < out/study/study.csv > docs/results/study.csv
  put study
}

conclusions()
{
  local out=out/conclusions views="bench-with trees-side flowers-against atrium" stage batch way
  local counts=(--map-sizes "1024,2048" --route image --frames 0)
  local published=crsm:as_published=on,crsma:as_published=on
  prepare gnomon_benchmark_fitting gnomon_test_lights
  # run NAME TECHNIQUES SCENES OPTION... : `gnomon compare` of each scene into $out/NAME.SCENE
  run() {
    local scene
    for scene in $3; do
      compareOnce "$out/$1.$scene" "$scene" --techniques "$2" "${@:4}"
    done
  }
  run hybrid "nsm,coherence,crsm,crsma,$published" "$views" "${counts[@]}"
  run times "coherence,$published" "$views" --route image --frames 7

  # Moderno fits maps to what the camera sees.
  local chain=selective:fit=once
  local chains="nsm:fit=once,$chain,$chain:coherence=off,$chain:leftovers=lit"
  for stage in neighbours={1,4,9}:adjacency=off neighbours=off:adjacency={edges,vertices}; do
    chains+=",$chain:coherence=off:$stage:leftovers=lit"
  done
  run chain "$chains" "$views" "${counts[@]}"

  local box=pcf:kernel=box:kernel_size disc=adaptive:early_out=ring:kernel_size
  local filters="nsm,nsm:depth=second,pcf:kernel_size=1,$box=3,$box=4,$box=11"
  filters+=",pcf:kernel=poisson:kernel_size=4,$disc=3:disc_grid=3,$disc=11:disc_grid=11"
  run filters "$filters,vsm:kernel_size=23" "bunny posts plates terrain" --route inline --frames 5
  run metric "$box=11,$box=11:metric=euclidean" "room office" --route image --frames 0

  local soft="$box=11,$disc=11:disc_grid=11,vsm:kernel_size=23,pcss,pcss:pcss_samples=high"
  soft+=,sampled:light_samples=512
  for batch in 1 2 4 8; do
    soft+=",sampled:batch=$batch"
  done
  run soft "$soft" "soft-stack soft-panels soft-plates soft-long-cube" --route image \
    --size 256x256 --frames 5 --truth-samples 1024

  # Curtis' dragon is the bunny here.
  local montecarlo=montecarlo:mc_layers=near,montecarlo
  for way in layers=near_far layers=eye:mc_search=linear; do
    montecarlo+=",montecarlo:mc_rays=2:mc_$way,montecarlo:mc_$way"
  done
  local curtis=(--map-sizes "512,1024" --size 384x288 --frames 7 --truth-samples 256)
  run montecarlo "$montecarlo" bunny "${curtis[@]}" --light-radius 5
  run montecarlo "$montecarlo" soft-long-cube "${curtis[@]}"

  $programs/gnomon_benchmark_fitting 2048 21 > $out/fitting.txt
  $programs/gnomon_test_lights --gtest_filter='ReducedMd5.*' > $out/md5.txt ||
    true # the page tells
  $here/collect.py conclusions $out
  put conclusions
}

# flights OPENGL : with a time budget, and an error or none
flights()
{
  local error budget
  for error in 0.005 1; do
    for budget in 1.6 2.4; do
      $programs/gnomon_benchmark_auto bunny atrium posts terrain \
        --error "$error" --budget "$budget" > out/flights.csv
      $here/collect.py flights "$1" out/flights.csv
    done
  done
}

auto()
{
  prepare gnomon_benchmark_auto
  $programs/gnomon_benchmark_auto bunny horse cat posts plates panels screens pole stack \
    long-cube letter cups office terrain props trees-side atrium cube half-plane room molecule \
    primitives bench-side flowers-side building-lit building soft-stack soft-panels soft-plates \
    soft-long-cube soft-window --places 200 --compared 12 > out/auto.csv
  $here/collect.py auto software out/auto.csv
  flights software
  put auto
}

growth()
{
  prepare gnomon_benchmark_growth
  $programs/gnomon_benchmark_growth -o docs/results --frames 11
  put growth
}

hard_cases()
{
  prepare gnomon_hard_cases
  $programs/gnomon_hard_cases --known tests/lab/hard/red_cells.tsv -o docs/results
  put hard_cases
}

split_rays()
{
  prepare gnomon_benchmark_split
  $programs/gnomon_benchmark_split --rays 100000000 -o docs/results/split_rays.csv
  put split_rays
}

drag_rate()
{
  local size
  prepare all
  for size in "64 64" "1024 1024"; do
    # shellcheck disable=SC2086
    PYTHONPATH=build/lab/lib/python3/dist-packages LD_LIBRARY_PATH=build/lab/lib \
      /usr/bin/python3 tests/lab/benchmarks/drag_rate.py $size
  done | awk 'NR == 1 || !/^pixels,/' > docs/results/drag_rate.csv
  put drag_rate
}

one_drawing()
{
  local scene
  prepare all
  for scene in bunny office trees-side terrain; do
    $programs/gnomon scenes --export "$scene" out/one_drawing
  done
  PYTHONPATH=build/lab/lib/python3/dist-packages LD_LIBRARY_PATH=build/lab/lib \
    /usr/bin/python3 tests/lab/benchmarks/one_drawing.py out/one_drawing \
    > docs/results/one_drawing.csv
  put one_drawing
}

gpu()
{
  if [ $# -gt 0 ]; then
    programs="$1"
  else
    prepare gnomon_benchmark_auto
  fi
  exactPrices gpu
  compareInto gpu soft bunny --techniques pcss,montecarlo,sampled,penumbra,raytraced \
    --route image --frames 11 --light-radius 5
  $programs/gnomon calibrate -o out/gpu/factors.txt
  $programs/gnomon_benchmark_auto bunny horse cat posts plates panels screens pole stack \
    long-cube letter cups office terrain props trees-side atrium --places 20 > out/gpu/auto.csv
  $here/collect.py auto gpu out/gpu/auto.csv
  flights gpu
  opengl="$(sed -n 's/.*"OpenGL": "\(.*\)",*/\1/p' out/gpu/bunny.hard/results.json)"
  put gpu
}

# inVtksFolders FOLDER DATA : sets folders for the functions that run VTK's own programs
inVtksFolders()
{
  vtk="$(cd "$1" && pwd)"
  data="$(cd "$2" && pwd)"
  out="$PWD/out/vtk_programs"
  mkdir -p "$out"
}

# runVtk NAME VARIANT TECHNIQUE FRAMES : messages, lights, times and pictures, as NAME.VARIANT.*
runVtk()
{
  local prefix="$out/$1.$2" status=0
  rm -f "$prefix".*
  (cd "$out" && env -u DISPLAY PROGRAM_OUT="$prefix" PROGRAM_TECHNIQUE="$3" PROGRAM_FRAMES="$4" \
    timeout 120 "$vtk/$1" -D "$data" -T "$out") > "$prefix.log" 2>&1 || status=$?
  echo "$status" > "$prefix.status"
}

vtk_programs()
{
  local name
  inVtksFolders "$@"
  while IFS=$'\t' read -r name _; do
    runVtk "$name" plain "" ""
    runVtk "$name" nsm nsm ""
    runVtk "$name" raytraced raytraced ""
  done < <(tail -n +2 $here/vtk_programs.tsv)
  $here/collect.py vtk_programs "$out"
  put vtk_programs
}

vtk_motion()
{
  local name plain nsm auto choice rest picture
  inVtksFolders "$@"
  for name in Mace FrustumClip TestManyActors TestGlyph3DMapperEdges TestVDWSpheres \
    TestCompositePolyDataMapper2MixedGeometryEdges TestBlockVisibility \
    TestGlyph3DMapperQuaternionArray TestVBOPLYMapper TestShadowMapPass; do
    runVtk "$name" raytraced raytraced ""
    runVtk "$name" nsm nsm 20
    runVtk "$name" auto auto 20
    rest=yes
    for picture in "$out/$name".auto.*.ppm; do
      cmp -s "$picture" "${picture/.auto./.raytraced.}" || rest=no
    done
    nsm="$(awk '{ printf "%.2f", $2 / $1 }' "$out/$name.nsm.motion")"
    IFS=$'\t' read -r plain auto choice < "$out/$name.auto.motion"
    printf '%s\t' "$name" "$(cat "$out/$name.auto.lights")" "$rest" "$plain" "$nsm" \
      "$(awk -v a="$auto" -v p="$plain" 'BEGIN { printf "%.2f", a / p }')"
    echo "${choice#the picture moves: }"
  done | {
    printf '%s\t' program light exact_at_rest plain_ms nsm_over_plain auto_over_plain
    echo choice
    cat
  } | $here/collect.py rows vtk_motion
  put vtk_motion
}

vtk_python_programs()
{
  local vtk out="$PWD/out/vtk_python_programs" program name
  vtk="$(cd "$1" && pwd)"
  prepare all
  rm -rf "$out"
  mkdir -p "$out"
  for program in Common/DataModel/PerlinNoise Common/DataModel/scalarConn \
    Filters/Core/constrainedDelaunay Filters/Extraction/ExtractTensors Filters/General/clipHex \
    Filters/General/TestDiscreteMarchingCubes Filters/Modeling/KlineBottle \
    Filters/Modeling/schwarz Filters/Modeling/subDivideTetra Filters/Modeling/TenEllip; do
    name="$(basename "$program")"
    env -u DISPLAY PYTHONPATH=build/lab/lib/python3/dist-packages timeout 120 \
      tests/lab/vtk_programs/main.py "$vtk/$(dirname "$program")/Testing/Python/$name.py" \
      "$out/$name" > "$out/$name.log" 2>&1 || echo "$name failed: $out/$name.log" >&2
    printf '%s\t%s\n' "$name" "$(sed 's/none$//' "$out/$name.result" || echo failed)"
  done | {
    printf '%s\t' program light in_shadow lit_and_changed not_as_raytraced
    echo messages
    cat
  } | $here/collect.py rows vtk_python_programs
  put vtk_python_programs
}

vtk_releases()
{
  # A namespace of its own unmounts all when the script ends.
  if [ "${GNOMON_VTK_MOUNTS:-}" != own ]; then
    export GNOMON_VTK_MOUNTS=own
    exec unshare --mount --propagation private $here/measure.sh vtk_releases "$@"
  fi
  local program out="$PWD/out/vtk_releases" techniques release root
  program=$(realpath "$1")/bin/gnomon
  shift
  mkdir -p "$out"
  techniques=$("$program" techniques | sed -nE 's/^([a-z]+) .*/\1/p')
  # renderBy NAME COMMAND... : the visibility of all scenes and techniques, as $out/NAME.*.exr
  renderBy() {
    local name=$1 scene technique
    shift
    for scene in stack posts terrain room primitives soft-stack; do
      for technique in $techniques; do
        rm -f "$out/$name.$scene.$technique".*
        "$@" render "$scene" --technique "$technique" --size 400x400 \
          -o "$out/$name.$scene.$technique.png" \
          --visibility "$out/$name.$scene.$technique.exr" > "$out/log" 2>&1 ||
          echo "$name: $scene by $technique: $(grep error "$out/log" | head -1)" >&2
      done
    done
    $here/collect.py machine "vtk_releases $name" "$("${@:1:$#-1}" dpkg-query -W \
      -f '${Package} ${Version}\n' 'libvtk9.[0-9]' 'libembree[0-9]*-[0-9]' libgl1-mesa-dri |
      sed -E 's/ [0-9]+:/ /; s/( [0-9.]+).*/\1/' | paste -sd, | sed 's/,/, /g')"
  }
  renderBy here env -u DISPLAY "$program"
  for release in "$@"; do
    root="${TMPDIR:-/tmp}/gnomon-vtk/$release"
    mkdir -p "$root$out"
    mount --bind "$out" "$root$out"
    mount --rbind /dev "$root/dev"
    mount -t proc proc "$root/proc"
    renderBy "$release" chroot "$root" env -u DISPLAY LC_ALL=C.UTF-8 /build/bin/gnomon
    # Pixels that are more than 0.5 off in a channel; none where a technique serves no such scene.
    for technique in $techniques; do
      for scene in stack posts terrain room primitives soft-stack; do
        echo "$release,$technique,$scene,$({ "$program" diff "$out/here.$scene.$technique.exr" \
          "$out/$release.$scene.$technique.exr" --max-difference 0.5 2> /dev/null || true; } |
          sed -nE 's/^([0-9]+) of .*/\1/p')"
      done
    done
  done | {
    echo release,technique,scene,pixels
    cat
  } > docs/results/vtk_releases.csv
  put
}

if [ $# -eq 0 ] || ! grep -q "^#   $1 " "${BASH_SOURCE[0]}"; then
  sed -n '2,/^set/{s/^# \{0,1\}//;/^set/d;p}' "${BASH_SOURCE[0]}" >&2
  exit 1
fi
"$@"
