#!/bin/bash
# Shows shadows on the Stanford bunny, on a bare Debian 12 or any machine set up like one: first one
# picture, without shadows, with VTK's own and ray traced, then a report that compares techniques.
#
#   examples/bunny.sh [--all]
#
# It compares the techniques to choose among, or all. Options go to `gnomon compare`.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source cmake/debian.sh

# say TEXT : says what begins, and when.
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
