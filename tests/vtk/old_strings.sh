#!/bin/bash
# Compiles the libraries and the Python package with the std::string of VTK's wheels, that from
# before C++11, and links nothing: the installed VTK has the new one.
#
#   tests/vtk/old_strings.sh [BUILD_FOLDER]
set -euo pipefail
cd "$(dirname "$0")/../.."
build=${1:-build/old-strings}

cmake --preset release -B "$build" -D CMAKE_BUILD_TYPE= -D GNOMON_BUILD_EXAMPLES=OFF \
  -D CMAKE_CXX_FLAGS=-D_GLIBCXX_USE_CXX11_ABI=0 > "$build.log"
mapfile -t objects < <(ninja -C "$build" -t targets all | sed -n 's/: CXX_COMPILER.*//p')
ninja -C "$build" "${objects[@]}"
if (cd "$build" && nm -A "${objects[@]}") | grep __cxx11; then
  echo "These objects use the new std::string." >&2
  exit 1
fi
echo "${#objects[@]} objects compiled"
