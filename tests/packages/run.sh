#!/bin/bash
# Builds Gnomon's Debian packages in a chroot of a release, installs them in a bare one, and tests
# there what they hold: the picture and the hours of examples/facade_hours.py, the project of
# docs/guide/start.md, and the program. Runs as root and needs debootstrap.
#
#   tests/packages/run.sh [--fresh] bookworm|trixie
#
# The chroots stay in the temporary folder (TMPDIR), packages in RELEASE-packages beside them. The
# next run builds on in the first one, unless it is --fresh; the bare one is always new.
set -euo pipefail
script=$(realpath "${BASH_SOURCE[0]}")
project=$(realpath "$(dirname "$script")/../..")
source "$project/tests/debian/chroot.sh"
arguments=("$@")

fresh=no
if [ "${1:-}" = --fresh ]; then
  fresh=yes
  shift
fi
case "$*" in
  bookworm | trixie) release=$1 ;;
  *)
    echo "Usage: tests/packages/run.sh [--fresh] bookworm|trixie" >&2
    exit 2
    ;;
esac
own_mounts "$script" "${arguments[@]}"

folder=${TMPDIR:-/tmp}/gnomon-packages
system=$folder/$release-system # what the chroots are copies of
build=$folder/$release-build
bare=$folder/$release-bare
packages=$folder/$release-packages

step=starting
trap 'echo "$release FAILED while $step, after $SECONDS s." >&2' ERR

# announce STEP: starts a step and says so.
announce()
{
  step="$1"
  echo "$SECONDS s: $step"
}

announce "making the chroots"
if [ "$fresh" = yes ]; then
  remove_chroot "$system"
  remove_chroot "$build"
fi
make_chroot "$release" "$system" "$folder/$release-debootstrap.log" || {
  cat "$folder/$release-debootstrap.log" >&2
  exit 1
}
if [ ! -e "$build" ]; then
  cp -a "$system" "$build"
fi

announce "installing what building takes"
mkdir -p "$build/build"
mount_chroot "$build" "$project"
# shellcheck disable=SC2046 # the packages are words
logged dependencies install_inside "$build" $(debian_packages "$project") lintian

announce "building packages"
logged configure inside "$build" sh -c 'cd /src && cmake --preset debian -B /build'
logged build inside "$build" cmake --build /build
rm -rf "$build/build/packages" "$packages"
logged cpack inside "$build" sh -c 'cd /build && cpack'
mkdir "$packages"
mv "$build"/build/packages/*.deb "$packages"
(cd "$packages" && du -h -- *.deb)

announce "checking packages"
cp -r "$packages" "$build/build/packages/debs"
inside "$build" sh -c 'lintian --allow-root /build/packages/debs/*.deb' |
  tee "$folder/$release-lintian.log"
! grep -q '^[EW]:' "$folder/$release-lintian.log" || false

announce "installing packages in a bare system"
remove_chroot "$bare"
cp -a "$system" "$bare"
mount_chroot "$bare" "$project"
mkdir "$bare/debs"
cp "$packages"/*.deb "$bare/debs"
logged update inside "$bare" apt-get update -qq
logged install inside "$bare" sh -c 'cd /debs && apt install --yes ./*.deb'
inside "$bare" dpkg-query -W -f '${Package} ${Version}\n' \
  '*gnomon*' libvtk9-dev 'libembree*' libgl1-mesa-dri

announce "drawing a shadow and telling hours of sun"
inside "$bare" mkdir /tmp/facade
inside "$bare" python3 /src/tests/python/test_facade_hours.py /tmp/facade
cp "$bare/tmp/facade/facade_hours.png" "$folder/$release-facade_hours.png"

announce "building the project of docs/guide/start.md"
logged compiler install_inside "$bare" g++ cmake ninja-build
inside "$bare" cmake -D PREFIX=/usr -D DOCUMENTATION=/usr/share/doc/gnomon-doc \
  -D CONSUMER_DIR=/src/tests/consumer -D PAGE=/usr/share/doc/gnomon-doc/docs/guide/start.md \
  -D WORK_DIR=/tmp/consumer -D CC=gcc -D CXX=g++ -D PYTHON=python3 \
  -D PYTHON_DESTINATION=lib/python3/dist-packages \
  -P /src/tests/consumer/TestInstalledPackage.cmake

announce "finding Gnomon without its program"
logged without inside "$bare" sh -c \
  'apt-get purge --yes gnomon && cmake -S /tmp/consumer/project -B /tmp/consumer/without'

announce "removing packages"
names=$(cd "$packages" && printf '%s\n' * | sed 's/_.*//' | grep -vx gnomon)
# shellcheck disable=SC2086 # the names are words
logged remove inside "$bare" apt-get purge --yes $names
left=$(find "$bare/usr" -iname '*gnomon*' ! -iname '*gnomonic*') # a projection of Boost's
if [ -n "$left" ]; then
  echo "Still there: $left" >&2
  false
fi
echo "$SECONDS s: $release passed"
