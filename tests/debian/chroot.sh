# Chroots of Debian releases, shared by tests/{vtk,packages,paraview}/run.sh, which source it and
# set $folder and $release. They run as root and need debootstrap. Mirror and proxies are those of
# this machine's apt.

# own_mounts SCRIPT [ARGUMENT...]: runs a script again in a mount namespace of its own, unless it
# runs in one: what it mounts ends with it.
own_mounts()
{
  if [ "$(id -u)" -ne 0 ]; then
    echo "A chroot needs root: sudo $*" >&2
    exit 2
  fi
  if [ "${GNOMON_CHROOT_MOUNTS:-}" != own ]; then
    export GNOMON_CHROOT_MOUNTS=own
    exec unshare --mount --propagation private "$@"
  fi
}

# inside ROOT COMMAND...: runs a command in a chroot.
inside()
{
  local root=$1
  shift
  chroot "$root" env -u DISPLAY -u TMPDIR DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 "$@"
}

# logged NAME COMMAND...: keeps a command's output in $folder/$release-NAME.log, and shows it if the
# command fails.
logged()
{
  local log=$folder/$release-$1.log
  shift
  "$@" > "$log" 2>&1 || {
    cat "$log" >&2
    return 1
  }
}

# remove_chroot ROOT
remove_chroot()
{
  if grep -q " $1/" /proc/self/mounts; then
    echo "Something is mounted in $1: unmount it first." >&2 # it would be removed with the chroot
    exit 1
  fi
  rm -rf "$1"
}

# Debian's own archive in this machine's apt; apt knows the origins once it has been updated.
find_mirror()
{
  apt-get indextargets --format '$(ORIGIN) $(LABEL) $(REPO_URI)' 'Created-By: Packages' |
    sed -n 's/^Debian Debian //p' | sort -u | head -n 1
}

# make_chroot RELEASE ROOT LOG: a minimal system, unless there is one. Fails if debootstrap does.
make_chroot()
{
  local release=$1 root=$2 log=$3
  if [ -e "$root/.gnomon-bootstrapped" ]; then
    return
  fi
  remove_chroot "$root"
  mkdir -p "$root"
  local mirror
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
    debootstrap --variant=minbase "$release" "$root" "$mirror" > "$log" 2>&1 || return
  echo "deb $mirror $release main" > "$root/etc/apt/sources.list"
  # An unstable release may be older than its Release file allows.
  {
    apt-config dump | grep -E '^Acquire::https?::' || true
    echo 'Acquire::Check-Valid-Until "false";'
  } > "$root/etc/apt/apt.conf.d/90gnomon"
  printf '#!/bin/sh\nexit 101\n' > "$root/usr/sbin/policy-rc.d" # no package starts a service
  chmod +x "$root/usr/sbin/policy-rc.d"
  echo force-unsafe-io > "$root/etc/dpkg/dpkg.cfg.d/gnomon" # the chroot may be made again
  touch "$root/.gnomon-bootstrapped"
}

# mount_chroot ROOT PROJECT: the project is at /src, not to be written.
mount_chroot()
{
  mkdir -p "$1/src"
  mount -t proc proc "$1/proc"
  mount --rbind /dev "$1/dev"
  mount --bind "$2" "$1/src"
  mount -o remount,bind,ro "$1/src"
}

# install_inside ROOT PACKAGE...: without what packages only recommend.
install_inside()
{
  local root=$1
  shift
  inside "$root" apt-get update -qq &&
    inside "$root" apt-get install -qq --yes --no-install-recommends -o Dpkg::Use-Pty=0 "$@"
}

# debian_packages PROJECT: what Gnomon is built, tested, packaged and run with.
debian_packages()
{
  sed 's/#.*//' "$1/cmake/debian-packages.txt" | xargs
}
