#!/bin/bash
# Installs Gnomon by pip in a chroot of Debian 13 or unstable, from its source distribution, without
# network, in a virtual environment that sees the system's VTK and PyVista; then draws a shadow and
# PyVista's gallery, runs the program and uninstalls. Runs as root and needs debootstrap.
#
#   tests/pip/run.sh [--fresh] [trixie|sid]
#
# The chroot stays in the temporary folder (TMPDIR) for the next run; --fresh makes a new one.
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
release=${1:-trixie}
case "$release" in
  trixie | sid) ;; # whose archives have scikit-build-core
  *)
    echo "Usage: tests/pip/run.sh [--fresh] [trixie|sid]" >&2
    exit 2
    ;;
esac
own_mounts "$script" "${arguments[@]}"

folder=${TMPDIR:-/tmp}/gnomon-pip
root=$folder/$release

step=starting
trap 'echo "pip FAILED while $step, after $SECONDS s." >&2' ERR

# announce STEP: starts a step and says so.
announce()
{
  step="$1"
  echo "$SECONDS s: $step"
}

# offline COMMAND: runs a shell's command in the chroot, without network.
offline()
{
  inside "$root" unshare --net bash -ec "cd /tmp/pip; PATH=/tmp/pip/venv/bin:\$PATH; $1"
}

announce "making the chroot"
if [ "$fresh" = yes ]; then
  remove_chroot "$root"
fi
make_chroot "$release" "$root" "$folder/$release.log"
mount_chroot "$root" "$project"
# shellcheck disable=SC2046 # the packages are words
logged packages install_inside "$root" $(debian_packages "$project") \
  python3-build python3-pyvista python3-scikit-build-core python3-tqdm python3-trimesh python3-venv
inside "$root" sh -c 'rm -rf /tmp/pip && mkdir /tmp/pip'
inside "$root" dpkg-query -W -f '${Package} ${Version}\n' python3-scikit-build-core python3-vtk9

announce "making the source distribution"
logged sdist offline 'python3 -m build --sdist --no-isolation --outdir . /src'
offline 'du -h *.tar.gz; tar xf *.tar.gz; rm *.tar.gz; mv gnomon-* source'

announce "installing by pip"
offline 'python3 -m venv --system-site-packages venv; find venv | sort > before'
start=$SECONDS
logged install offline 'time pip install --no-index --no-build-isolation ./source'
tail -n 3 "$folder/$release-install.log"
echo "pip install took $((SECONDS - start)) s."

announce "drawing a shadow"
offline 'python /src/tests/python/test_facade_hours.py .'
offline 'python /src/examples/shadows.py shadows.png | tee said; grep -q "In shadow: [1-9]" said'
cp "$root/tmp/pip/shadows.png" "$folder"

announce "drawing PyVista's gallery"
offline 'python /src/tests/python/test_meshes.py'
offline 'xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" python /src/tests/python/test_pyvista.py'

announce "running the program"
offline 'gnomon --version; gnomon render bunny -o bunny.png --size 64x64'
offline 'pip show --files gnomon > files; cat files; ! grep -E "include|share|cmake|\.so\." files'

announce "uninstalling"
offline 'pip uninstall --yes gnomon; find venv | sort | diff before -'
echo "$SECONDS s: pip passed"
