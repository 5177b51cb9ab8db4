#!/bin/bash
# Builds everything and passes the tests, on a bare Debian 12 or any machine set up like one.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source cmake/debian.sh

step="installing packages"
trap 'echo "FAILED while $step, after $SECONDS s." >&2' ERR
set -o errtrace

install_packages
packages_end=$SECONDS

step="checking the format (clang-format -i puts it right)"
find lights shadowtech plugin examples tests \
  \( -name "*.h" -o -name "*.cpp" -o -name "*.cxx" \) -print0 |
  xargs -0 clang-format --dry-run --Werror

step="building"
build ci
build_end=$SECONDS

step="testing"
env -u DISPLAY ctest --preset ci
tests_end=$SECONDS

echo "Seconds: packages $packages_end, build $((build_end - packages_end)), tests $((tests_end - build_end))."
