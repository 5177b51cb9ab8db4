#!/bin/bash
# Builds Gnomon with the VTK of a Debian release and passes its quick tests and those of all
# examples, in a chroot. Runs as root and needs debootstrap. VTK is 9.1 in bookworm, 9.3 in trixie
# and newer in sid.
#
#   tests/vtk/run.sh [--fresh] bookworm|trixie|sid
#
# The chroot stays in the temporary folder (TMPDIR) for the next run; --fresh makes a new one. Its
# mirror and its proxies are those of this machine's apt. If packages of sid do not install, the
# script says so with their versions and succeeds: nothing of Gnomon was tested. Of another release
# that is a failure, with status 3.
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
  bookworm | trixie | sid) release=$1 ;;
  *)
    echo "Usage: tests/vtk/run.sh [--fresh] bookworm|trixie|sid" >&2
    exit 2
    ;;
esac
own_mounts "$script" "${arguments[@]}"

folder=${TMPDIR:-/tmp}/gnomon-vtk
root=$folder/$release

# untested WHAT: ends a run in which Gnomon had no part.
untested()
{
  echo "$release: NOT TESTED: $1."
  if [ -e "$root/usr/bin/apt-cache" ]; then
    inside "$root" apt-cache policy g++ libvtk9-dev libembree-dev libgl1-mesa-dri |
      grep -E '^[a-z]|Candidate' || true
  fi
  [ "$release" = sid ] || exit 3 # only an unstable archive may be broken
  exit 0
}

if [ "$fresh" = yes ]; then
  remove_chroot "$root"
fi
make_chroot "$release" "$root" "$folder/$release.log" ||
  untested "debootstrap failed ($folder/$release.log)"
mkdir -p "$root/build"
mount_chroot "$root" "$project"

echo "$SECONDS s: installing packages"
# shellcheck disable=SC2046 # the packages are words
install_inside "$root" $(debian_packages "$project") libvtk9-qt-dev \
  > "$folder/$release-packages.log" 2>&1 ||
  untested "its packages do not install ($folder/$release-packages.log)"
# Not in all releases; what takes it is skipped without.
for package in python3-pyvista python3-tqdm python3-trimesh; do
  inside "$root" apt-get install -qq --yes --no-install-recommends -o Dpkg::Use-Pty=0 $package \
    > "$folder/$release-$package.log" 2>&1 || echo "$release has no $package"
done
inside "$root" dpkg-query -W -f '${Package} ${Version}\n' \
  g++ libvtk9-dev libembree-dev libgl1-mesa-dri

echo "$SECONDS s: building"
logged configure inside "$root" sh -c 'cd /src && cmake --preset ci -B /build'
inside "$root" cmake --build /build --target gnomon_quick_tests examples/all

echo "$SECONDS s: testing"
inside "$root" ctest --test-dir /build --label-regex '^quick$' --no-tests=error \
  --output-on-failure --parallel "$(nproc)" --timeout 1200
inside "$root" ctest --test-dir /build --tests-regex '^(Example|Python)' --output-on-failure \
  --parallel "$(nproc)"
echo "$SECONDS s: $release passed"
