#!/bin/bash
# Builds the plugin for ParaView in a chroot of Debian bookworm, and draws with it on several
# processes: what they show must be what one process shows. Runs as root and needs debootstrap.
#
#   tests/paraview/run.sh [--fresh] [--measure] [--users]
#
# It prints a table of what users draw, and writes it to docs/results/paraview.csv; --users draws
# nothing else.
# The chroot stays in the temporary folder (TMPDIR) for the next run; --fresh makes a new one.
# --measure measures times instead, and writes docs/results/paraview_times.csv.
set -euo pipefail
script=$(realpath "${BASH_SOURCE[0]}")
project=$(realpath "$(dirname "$script")/../..")
source "$project/tests/debian/chroot.sh"
arguments=("$@")

fresh=no
measure=no
users=no
for argument in "$@"; do
  case "$argument" in
    --fresh) fresh=yes ;;
    --measure) measure=yes ;;
    --users) users=yes ;;
    *)
      echo "Usage: tests/paraview/run.sh [--fresh] [--measure] [--users]" >&2
      exit 2
      ;;
  esac
done
own_mounts "$script" "${arguments[@]}"

release=bookworm
folder=${TMPDIR:-/tmp}/gnomon-paraview
root=$folder/$release
work=/tmp/gnomon # in the chroot
data=$work/data
scripts=/src/tests/paraview

# with_display COMMAND...: runs a command in the chroot on a display of its own. The servers of
# displays need -noreset: processes come and go.
with_display()
{
  inside "$root" env GNOMON_PARAVIEW_PLUGIN=$plugin PYTHONDONTWRITEBYTECODE=1 LP_NUM_THREADS=1 \
    HWLOC_COMPONENTS=-linux OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 \
    OMPI_MCA_btl_vader_single_copy_mechanism=none OMPI_MCA_rmaps_base_oversubscribe=1 \
    OMPI_MCA_mpi_yield_when_idle=1 \
    timeout --kill-after=10 "$limit" xvfb-run -a -s '-screen 0 1280x1024x24 -noreset' "$@"
}

# batch PROCESSES SCRIPT ARGUMENT...: runs a scenario
batch()
{
  local processes=$1 name=$2
  shift 2
  if [ "$processes" = 1 ]; then
    with_display pvbatch "$scripts/$name" "$@"
  else
    with_display mpirun -np "$processes" pvbatch "$scripts/$name" "$@"
  fi
}

# beside_server PROCESSES OPTIONS SCRIPT ARGUMENT...: runs a scenario as the client of a server; its
# last argument is the server's port.
beside_server()
{
  local processes=$1 options=$2 name=$3 port=11133 server
  shift 3
  : > "$folder/server.log" # an earlier server's
  # shellcheck disable=SC2086 # the options are words
  with_display mpirun -np "$processes" pvserver --server-port=$port $options \
    > "$folder/server.log" 2>&1 &
  server=$!
  for _ in $(seq 60); do
    ! grep -q 'Accepting connection' "$folder/server.log" || break
    sleep 0.5
  done
  local status=0
  with_display pvpython "$scripts/$name" "$@" $port || status=$?
  if [ "$status" != 0 ]; then
    kill "$server" 2> /dev/null || true
  fi
  wait "$server" || status=$?
  grep -E 'ERR\||WARN\|' "$folder/server.log" || true
  return "$status"
}

machine()
{
  local model
  model=$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1)
  echo "$model, $(nproc) processors; OpenGL by software (llvmpipe)"
}

failures=0
limit=600 # seconds until a scenario counts as one that hangs
expected='nothing'

# scenario NAME COMMAND...: shows what a scenario prints. It fails if the command does or prints
# errors that are not expected, or if the last line is not "passed".
scenario()
{
  local log="$folder/$1.log" start=$SECONDS status=0
  echo "$SECONDS s: $1"
  shift
  "$@" > "$log" 2>&1 || status=$?
  grep -E '^(ok  |FAIL)' "$log" || true
  if [ "$status" = 124 ] || [ "$status" = 137 ]; then
    echo "FAIL it hangs: no end in $limit s"
  elif [ "$status" != 0 ] || ! grep -q '^passed$' "$log"; then
    echo "FAIL it ended with status $status"
  elif grep -E 'ERR\||WARN\||[Ee]rror' "$log" |
    grep -v -E "^(ok  |FAIL)|$expected" > "$log.errors"; then
    echo "FAIL it printed errors:"
    head -n 20 "$log.errors"
  else
    echo "passed after $((SECONDS - start)) s"
    return
  fi
  echo "The output is in $log."
  failures=$((failures + 1))
}

# expect NAME COUNT TEXT: checks that processes have printed a line
expect()
{
  local found
  found=$(grep -c -E "(ERR|WARN)\|.*$3" "$folder/$1.log" || true)
  if [ "$found" = "$2" ]; then
    echo "ok   $2 processes say: $3"
  else
    echo "FAIL $found processes instead of $2 say: $3"
    failures=$((failures + 1))
  fi
}

if [ "$fresh" = yes ]; then
  remove_chroot "$root"
fi
make_chroot "$release" "$root" "$folder/debootstrap.log" || {
  cat "$folder/debootstrap.log" >&2
  exit 1
}
mkdir -p "$root/build"
mount_chroot "$root" "$project"

echo "$SECONDS s: installing packages"
# shellcheck disable=SC2046 # the packages are words
logged packages install_inside "$root" \
  $(sed 's/#.*//' "$project/cmake/paraview-packages.txt" | xargs)
versions=$(inside "$root" dpkg-query -W -f 'version,,${Package},${Version}\n' \
  paraview openmpi-bin libgl1-mesa-dri)
echo "$versions"

echo "$SECONDS s: building"
logged configure inside "$root" cmake -S /src/plugin/paraview -B /build/paraview \
  -D GNOMON_WARNINGS_AS_ERRORS=ON
logged build inside "$root" cmake --build /build/paraview --parallel
plugin=/build/paraview/lib/paraview-5.11/plugins/GnomonShadows/GnomonShadows.so
rm -rf "${root:?}$work"
inside "$root" mkdir -p "$data"

if [ "$measure" = yes ]; then
  limit=1800
  scenario measure batch 3 measure.py "$work/paraview_times.csv"
  if [ -e "$root$work/paraview_times.csv" ]; then
    mv "$root$work/paraview_times.csv" "$project/docs/results/"
  fi
  exit "$failures"
fi

for case in surface_lic reduced annotations views looks terminators casters dragging; do
  for processes in 1 2 3; do
    scenario "users-$case-$processes" batch "$processes" users.py "$case" "$work/users"
  done
done
scenario users-reduced-client beside_server 2 "" users.py reduced "$work/users"

# The table, from the rows that the scenarios print.
table=$project/docs/results/paraview.csv
{
  echo "case,processes,what,figure"
  echo "$versions"
  sed -n 's/^row,//p' "$folder"/users-*.log
} > "$table"
sed 's/,,/, ,/g' "$table" | column -s , -t
if [ "$users" = yes ]; then
  exit "$failures"
fi

logged prepare inside "$root" env PYTHONDONTWRITEBYTECODE=1 python3 $scripts/prepare.py "$data"
for processes in 2 3 4; do
  scenario "draw-$processes" batch "$processes" same_visibility.py shared "$data" "$work"
done
scenario compare batch 1 same_visibility.py alone "$data" "$work" 2 3 4
scenario random batch 3 random_changes.py shared "$data" "$work/random"
scenario random-alone batch 1 random_changes.py alone "$data" "$work/random"
scenario selections batch 3 selects.py "$data"
scenario batch-picture batch 3 picture.py "$data" "$work/batch.png"
scenario client beside_server 3 "" picture.py "$data" "$work/client.png" "$work/batch.png"
expected="Tile displays and CAVEs have no shadows|Warning: In vtkPVGnomonShadows"
scenario tiles beside_server 2 "--tdx 2 --tdy 1" tiles.py
expect tiles 3 "Tile displays and CAVEs have no shadows"
expected="'pcf' sees the casters of one process|the processes have different lights"
scenario refusals batch 3 refusals.py "$data" "$work"
expect refusals 3 "'pcf' sees the casters of one process"
expect refusals 3 "The scene is drawn without shadows: the processes have different lights"

if [ "$failures" != 0 ]; then
  echo "$SECONDS s: $failures failures" >&2
  exit 1
fi
echo "$SECONDS s: passed"
