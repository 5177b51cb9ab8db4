#!/bin/bash
# Build Gnomon and run its tests, on a bare Debian 12 or any machine set up like one.
#
#   tests/run.sh        the quick tier (tests/main/QuickTier.h)
#   tests/run.sh --all  everything
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

case "$*" in
  "") tier=quick ;;
  --all) tier=ci ;;
  *)
    echo "Unknown arguments: $*" >&2
    echo "Usage: tests/run.sh [--all]" >&2
    exit 2
    ;;
esac

source cmake/debian.sh

step=starting
trap 'echo "FAILED while $step, after $SECONDS s." >&2' ERR
set -o errtrace

# announce STEP: start a step and print its name.
announce()
{
  step="$1"
  echo "$SECONDS s: $step"
}

announce "installing packages"
install_packages libvtk9-qt-dev # for an example
packages_end=$SECONDS

announce "checking the format (clang-format -i puts it right)"
find lights shadowtech plugin examples tests \
  \( -name "*.h" -o -name "*.cpp" -o -name "*.cxx" \) -print0 |
  xargs -0 clang-format --dry-run --Werror

announce "building"
cmake --preset ci
cmake --build --preset "$tier"
build_end=$SECONDS

announce "testing"
env -u DISPLAY ctest --preset "$tier"
tests_end=$SECONDS

echo "Seconds: packages $packages_end, build $((build_end - packages_end))," \
  "tests $((tests_end - build_end))."
