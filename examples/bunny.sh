#!/bin/bash
# Show shadows on the Stanford bunny, on a bare Debian 12 or a machine set up like one. The first
# picture shows no shadows, VTK's own and ray-traced shadows. A report then compares techniques.
#
#   examples/bunny.sh [--all]
#
# By default, it compares the recommended techniques; --all compares all. Options go to `gnomon
# compare`.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source cmake/debian.sh

# say TEXT : print the elapsed time and what begins.
say()
{
  printf '[%3d s] %s\n' "$SECONDS" "$1"
}

say "1 of 4: installing the packages of cmake/debian-packages.txt that are missing"
install_packages
say "2 of 4: compiling the library and the program gnomon on $(nproc) processors"
build_gnomon
say "3 of 4: drawing the first picture"
build/release/bin/gnomon compare bunny -o "$PWD/out/bunny" "$@" |
  while read -r line; do
    say "$line"
    case "$line" in
      "First picture"*) say "4 of 4: comparing techniques with ray tracing: error, time, memory" ;;
    esac
  done
say "The report: $PWD/out/bunny/report.html"
