#!/bin/bash
# Drags the mouse in programs of other toolkits that use Gnomon: Qt's widgets, Qt Quick, PyQt and
# wxPython of Debian 12. Takes pictures in its vedo, Mayavi and PCL, with a display and without.
#
#   tests/clients/run.sh [PREFIX]
#
# PREFIX is where Gnomon is installed; without it, the script builds and installs Gnomon. Builds and
# logs stay in the temporary folder (TMPDIR). A picture must be finished three seconds after a drag,
# so the machine must have nothing else to do.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source cmake/debian.sh
source tests/debian/chroot.sh # logged, find_mirror

release=bookworm
folder=${TMPDIR:-/tmp}/gnomon-clients
build=$folder/build
prefix=${1:-$folder/prefix}
mkdir -p "$folder/run"
chmod 700 "$folder/run" # Qt asks for that

build_gnomon_prefix()
{
  cmake --preset release &&
    cmake --build --preset release &&
    cmake --install build/release --prefix "$prefix"
}

# Debian's VTK lacks the library for Qt Quick. Debian's source package of VTK has it.
get_qt_quick()
{
  local apt=$folder/apt
  local options=(-o "Dir::Etc::SourceList=$apt/sources.list" -o "Dir::Etc::SourceParts=$apt/none"
    -o "Dir::State::Lists=$apt/lists")
  mkdir -p "$apt/lists/partial" "$apt/none" "$folder/qt_quick"
  echo "deb-src $(find_mirror) $release main" > "$apt/sources.list"
  apt-get "${options[@]}" update &&
    (cd "$apt" && apt-get "${options[@]}" source --download-only vtk9) &&
    tar --extract --file "$apt"/vtk9_*.orig.tar.xz --directory "$folder/qt_quick" \
      --strip-components 3 --wildcards '*/GUISupport/QtQuick/QQuickVTK*'
}

build_clients()
{
  cmake -S tests/clients -B "$build" -G Ninja -D CMAKE_BUILD_TYPE=Release \
    -D CMAKE_PREFIX_PATH="$prefix" -D QT_QUICK_SOURCES="$folder/qt_quick" &&
    cmake --build "$build"
}

table=()
failures=0

# run NAME COMMAND...: runs a client, or what checks it, and counts its lines.
run()
{
  local name=$1 log=$folder/$1.log result=passed
  shift
  echo "$SECONDS s: $name"
  env PYTHONPATH="$prefix/lib/python3/dist-packages" PYTHONDONTWRITEBYTECODE=1 \
    XDG_RUNTIME_DIR="$folder/run" GDK_BACKEND=x11 NO_AT_BRIDGE=1 "$@" \
    2>&1 | tee "$log" || result=FAILED
  [ "$result" = passed ] || failures=$((failures + 1))
  table+=("$(printf '%-20s %6d  %s' "$name" "$(grep -c -E '^(ok  |FAIL)' "$log")" "$result")")
}

# client NAME [--unfinished WORD]... COMMAND...: checks a client on a display of its own (drag.py).
client()
{
  local name=$1 screen=$folder/screen/$1
  shift
  mkdir -p "$screen"
  run "$name" xvfb-run -a -s "-screen 0 640x480x24 -nocursor -noreset -fbdir $screen" \
    env QT_QPA_PLATFORM=xcb timeout 600 \
    /usr/bin/python3 tests/clients/drag.py --screen "$screen/Xvfb_screen0" "$@"
}

# pictures NAME COMMAND...: runs a client that checks its own pictures, with a display and without.
pictures()
{
  local name=$1
  shift
  run "$name" xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" timeout 600 "$@"
  run "${name}_egl" env -u DISPLAY QT_QPA_PLATFORM=offscreen timeout 600 "$@" egl
}

echo "$SECONDS s: installing packages"
install_packages libvtk9-qt-dev python3-pyqt5 python3-wxgtk4.0 qtdeclarative5-dev xdotool \
  python3-vedo mayavi2 libpcl-dev
echo "$SECONDS s: building"
[ $# -gt 0 ] || logged gnomon build_gnomon_prefix
[ -e "$folder/qt_quick/QQuickVTKRenderItem.h" ] || logged qt_quick get_qt_quick
logged clients build_clients

# A client is a program here (drag.py says what it takes and prints, or pictures.py checks it), and
# a line below.
client qt_widget --unfinished reparent --unfinished delete "$build/qt_widget"
client qt_quick_basic env QSG_RENDER_LOOP=basic "$build/qt_quick"
client qt_quick_threaded env QSG_RENDER_LOOP=threaded "$build/qt_quick"
client pyqt_widget /usr/bin/python3 tests/clients/pyqt_widget.py
client wx_widget /usr/bin/python3 tests/clients/wx_widget.py
pictures vedo /usr/bin/python3 tests/clients/vedo_plotter.py
pictures mayavi /usr/bin/python3 tests/clients/mayavi_figure.py
pictures pcl "$build/pcl_visualizer"

printf '%-20s %6s  %s\n' client checks result
printf '%s\n' "${table[@]}"
echo "$SECONDS s: $failures clients failed"
[ "$failures" = 0 ]
