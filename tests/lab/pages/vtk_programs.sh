#!/bin/bash
# Runs programs written for plain VTK without and with Gnomon's shadows, compares messages and
# pictures, and writes docs/results/vtk_programs.md.
#
#   tests/lab/pages/vtk_programs.sh FOLDER DATA
#
# FOLDER has the programs, each linked to tests/lab/vtk_programs/main.cxx. DATA has VTK's folder Data.
# tests/lab/pages/vtk_programs.tsv says what each shows. Pictures are in out/vtk_programs.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../../.."
source tests/lab/pages/common.sh

takePrograms "$@"
out="$PWD/out/vtk_programs"
mkdir -p "$out"

# runOnce NAME VARIANT [TECHNIQUE] : messages, lights and pictures, as $out/NAME.VARIANT.*
runOnce() {
  local prefix="$out/$1.$2" status=0
  rm -f "$prefix".*
  (cd "$out" && env -u DISPLAY PROGRAM_OUT="$prefix" PROGRAM_TECHNIQUE="${3-}" \
    timeout 60 "$programs/$1" -D "$data" -T "$out") > "$prefix.log" 2>&1 || status=$?
  echo "$status" > "$prefix.status"
}

# runAll NAME : without Gnomon, by the default technique, by ray tracing
runAll() {
  runOnce "$1" plain
  runOnce "$1" nsm nsm
  runOnce "$1" raytraced raytraced
}
export -f runOnce runAll
export out programs data

tail -n +2 tests/lab/pages/vtk_programs.tsv | cut -f 1 | xargs -P "$(nproc)" -I NAME bash -c 'runAll NAME'
python3 tests/lab/pages/vtk_programs_page.py "$out" "$(machine)"
