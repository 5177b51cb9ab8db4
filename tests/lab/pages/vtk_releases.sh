#!/bin/bash
# Compares visibility of all techniques between the VTK of this machine and those of other Debian
# releases, and writes docs/results/vtk_releases.md.
#
#   tests/lab/pages/vtk_releases.sh BUILD RELEASE...
#
# BUILD is a build folder of this machine. `tests/vtk/run.sh RELEASE` has made each release's
# chroot. Runs as root. Files are in out/vtk_releases.
set -euo pipefail
# Mounts below are in a namespace of their own, which ends with the script.
if [ "${GNOMON_VTK_MOUNTS:-}" != own ]; then
  export GNOMON_VTK_MOUNTS=own
  exec unshare --mount --propagation private "$(realpath "${BASH_SOURCE[0]}")" "$@"
fi
program=$(realpath "$1")/bin/gnomon
shift
cd "$(dirname "${BASH_SOURCE[0]}")/../../.."
out="$PWD/out/vtk_releases"
size=400x400
pixels=160000
scenes=(stack posts terrain room primitives soft-stack)
mkdir -p "$out"

# versionsOf COMMAND... : VTK, Embree and Mesa of a system
versionsOf() {
  "$@" dpkg-query -W -f '${db:Status-Status} ${Package} ${Version}\n' 'libvtk9*' 'libembree*' \
    libgl1-mesa-dri | sed -n 's/^installed //p' | grep -vE -- '-(dev|qt|doc|java)|^python' |
    sed -E 's/ [0-9]+:/ /; s/( [0-9.]+).*/\1/' | paste -sd, | sed 's/,/, /g'
}

# renderBy NAME COMMAND... : the visibility of all scenes and techniques, as $out/NAME.*.exr
renderBy() {
  local name=$1 scene technique
  shift
  for scene in "${scenes[@]}"; do
    for technique in $techniques; do
      rm -f "$out/$name.$scene.$technique".*
      "$@" render "$scene" --technique "$technique" --size "$size" \
        -o "$out/$name.$scene.$technique.png" \
        --visibility "$out/$name.$scene.$technique.exr" > "$out/log" 2>&1 ||
        echo "$name: $scene by $technique: $(grep error "$out/log" | head -1)" >&2
    done
  done
  if ! compgen -G "$out/$name.*.exr" > /dev/null; then
    echo "$name draws nothing: $(tail -1 "$out/log")" >&2
    exit 1
  fi
}

techniques=$("$program" techniques | sed -nE 's/^([a-z]+) .*/\1/p')
renderBy here env -u DISPLAY "$program"
versions="- here: $(versionsOf env)"
header="| technique |"
rule="|---|"
for release in "$@"; do
  root="${TMPDIR:-/tmp}/gnomon-vtk/$release"
  mkdir -p "$root$out"
  mount --bind "$out" "$root$out"
  mount --rbind /dev "$root/dev"
  mount -t proc proc "$root/proc"
  renderBy "$release" chroot "$root" env -u DISPLAY LC_ALL=C.UTF-8 /build/bin/gnomon
  versions+=$'\n'"- $release: $(versionsOf chroot "$root")"
  header+=" $release |"
  rule+="---|"
done

# off SCENE TECHNIQUE RELEASE : pixels whose visibility is more than 0.5 off; ? without pictures
off() {
  local here="$out/here.$1.$2.exr" there="$out/$3.$1.$2.exr"
  if [ -e "$here" ] && [ -e "$there" ]; then
    local count
    count=$({ "$program" diff "$here" "$there" --max-difference 0.5 2> /dev/null || true; } |
      sed -nE 's/^([0-9]+) of .*/\1/p')
    echo "${count:-not comparable}"
  else
    echo "?"
  fi
}

rows=""
for technique in $techniques; do
  rows+="| \`$technique\` |"
  for release in "$@"; do
    cells=""
    for scene in "${scenes[@]}"; do
      cells+=" $(off "$scene" "$technique" "$release"),"
    done
    rows+="${cells%,} |"
  done
  rows+=$'\n'
done

cat > docs/results/vtk_releases.md << END
# The same shadows by other VTK

Pixels, of $pixels, in which a channel of \`gnomon render --visibility\` (visibility, positions,
normals, coverage) is more than 0.5 off that of this machine, in the scenes
${scenes[*]}.
A ? stands for a scene that the technique does not serve. Written by \`tests/lab/pages/vtk_releases.sh\`.

$versions

$header
$rule
${rows%$'\n'}
END
