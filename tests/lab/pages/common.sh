# shellcheck shell=bash
# Functions that the scripts of this folder share.

source cmake/debian.sh

# prepare TARGET... : installs packages, and builds `gnomon` and these targets in build/lab
prepare()
{
  install_packages libvtk9-qt-dev
  mkdir -p build
  cmake --preset lab > build/configure.log
  cmake --build --preset lab --target gnomon "$@"
}

# compareOnce FOLDER SCENE OPTION... : `gnomon compare` into the folder, unless the same program did just that before
compareOnce()
{
  local folder="$1"
  local how
  how="${*:2} $(cat build/lab/bin/gnomon build/lab/lib/libGnomon*.so | cksum)"
  if [ "$(cat "$folder/how.txt" 2> /dev/null)" = "$how" ]; then
    return
  fi
  rm -rf "$folder" "$folder.part"
  build/lab/bin/gnomon compare "$2" -o "$folder.part" "${@:3}"
  echo "$how" > "$folder.part/how.txt"
  mv "$folder.part" "$folder"
}

# flights PROGRAM : flights of gnomon_benchmark_auto, with a time budget and an error or none
flights()
{
  local error budget
  for error in 0.005 1; do
    for budget in 1.6 2.4; do
      "$1" bunny atrium posts terrain --error "$error" --budget "$budget"
    done
  done | awk 'NR == 1 || !/^scene,/'
}

# The machine of the measurement.
machine()
{
  echo "$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1), $(nproc) processors; OpenGL by software (llvmpipe)"
}

# takePrograms FOLDER DATA : sets `programs` and `data` for scripts that run VTK's own programs
takePrograms()
{
  if [ $# -ne 2 ]; then
    echo "usage: docs/$(basename "$0") FOLDER DATA" >&2
    exit 1
  fi
  programs="$(cd "$1" && pwd)"
  data="$(cd "$2" && pwd)"
}
