#!/bin/bash
# Builds Gnomon with the VTK of a Debian release and passes its quick tests, in a chroot. Runs as
# root and needs debootstrap. VTK is 9.1 in bookworm, 9.3 in trixie and newer in sid.
#
#   tests/vtk/run.sh [--fresh] bookworm|trixie|sid
#
# The chroot stays in the temporary folder (TMPDIR) for the next run; --fresh makes a new one. Its
# mirror and its proxies are those of this machine's apt. If packages of the release do not install,
# the script says so with their versions and succeeds: nothing of Gnomon was tested.
set -euo pipefail
script=$(realpath "${BASH_SOURCE[0]}")
project=$(realpath "$(dirname "$script")/../..")

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
if [ "$(id -u)" -ne 0 ]; then
  echo "A chroot needs root: sudo tests/vtk/run.sh $release" >&2
  exit 2
fi

# What is mounted below is mounted in a namespace of its own, which ends with the script.
if [ "${GNOMON_VTK_MOUNTS:-}" != own ]; then
  export GNOMON_VTK_MOUNTS=own
  [ "$fresh" = no ] || set -- --fresh "$@"
  exec unshare --mount --propagation private "$script" "$@"
fi

folder=${TMPDIR:-/tmp}/gnomon-vtk
root=$folder/$release
packages=$(sed 's/#.*//' "$project/cmake/debian-packages.txt" | xargs)

# inside COMMAND...: runs a command in the chroot.
inside()
{
  chroot "$root" env -u DISPLAY -u TMPDIR DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 "$@"
}

# untested WHAT: ends a run in which Gnomon had no part.
untested()
{
  echo "$release: NOT TESTED: $1."
  if [ -e "$root/usr/bin/apt-cache" ]; then
    inside apt-cache policy g++ libvtk9-dev libembree-dev libgl1-mesa-dri |
      grep -E '^[a-z]|Candidate' || true
  fi
  exit 0
}

# Debian's own archive in this machine's apt; apt knows the origins once it has been updated.
find_mirror()
{
  apt-get indextargets --format '$(ORIGIN) $(LABEL) $(REPO_URI)' 'Created-By: Packages' |
    sed -n 's/^Debian Debian //p' | sort -u | head -n 1
}

if grep -q " $root/" /proc/self/mounts; then
  echo "Something is mounted in $root: unmount it first." >&2 # it would be removed with the chroot
  exit 1
fi
if [ "$fresh" = yes ]; then
  rm -rf "$root"
fi
if [ ! -e "$root/.gnomon-bootstrapped" ]; then
  rm -rf "$root"
  mkdir -p "$root"
  mirror=$(find_mirror)
  if [ -z "$mirror" ]; then
    apt-get update -qq
    mirror=$(find_mirror)
  fi
  if [ -z "$mirror" ]; then
    echo "This machine's apt names no archive of Debian's." >&2
    exit 1
  fi
  eval "$(apt-config shell http_proxy Acquire::http::Proxy https_proxy Acquire::https::Proxy)"
  http_proxy=${http_proxy:-} https_proxy=${https_proxy:-} \
    debootstrap --variant=minbase "$release" "$root" "$mirror" > "$folder/$release.log" 2>&1 ||
    untested "debootstrap failed ($folder/$release.log)"
  echo "deb $mirror $release main" > "$root/etc/apt/sources.list"
  # An unstable release may be older than its Release file allows.
  {
    apt-config dump | grep -E '^Acquire::https?::' || true
    echo 'Acquire::Check-Valid-Until "false";'
  } > "$root/etc/apt/apt.conf.d/90gnomon"
  printf '#!/bin/sh\nexit 101\n' > "$root/usr/sbin/policy-rc.d" # no package starts a service
  chmod +x "$root/usr/sbin/policy-rc.d"
  touch "$root/.gnomon-bootstrapped"
fi

mkdir -p "$root/src" "$root/build"
mount -t proc proc "$root/proc"
mount --rbind /dev "$root/dev"
mount --bind "$project" "$root/src"
mount -o remount,bind,ro "$root/src"

echo "$SECONDS s: installing packages"
# shellcheck disable=SC2086 # the packages are words
{
  inside apt-get update -qq &&
    inside apt-get install -qq --yes --no-install-recommends -o Dpkg::Use-Pty=0 $packages
} > "$folder/$release-packages.log" 2>&1 ||
  untested "its packages do not install ($folder/$release-packages.log)"
# Not in all releases; what takes it is skipped without.
inside apt-get install -qq --yes --no-install-recommends -o Dpkg::Use-Pty=0 python3-pyvista \
  > "$folder/$release-optional.log" 2>&1 || echo "$release has no python3-pyvista"
inside dpkg-query -W -f '${Package} ${Version}\n' g++ libvtk9-dev libembree-dev libgl1-mesa-dri

echo "$SECONDS s: building"
inside sh -c 'cd /src && cmake --preset ci -B /build' > "$folder/$release-configure.log" 2>&1 || {
  cat "$folder/$release-configure.log" >&2
  exit 1
}
inside cmake --build /build --target gnomon_quick_tests

echo "$SECONDS s: testing"
inside ctest --test-dir /build --label-regex '^quick$' --no-tests=error --output-on-failure \
  --parallel "$(nproc)" --timeout 1200
echo "$SECONDS s: $release passed"
