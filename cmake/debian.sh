# Set-up on Debian 12, for examples/bunny.sh, tests/run.sh and tests/lab/pages.

# install_packages [PACKAGE...]: installs what cmake/debian-packages.txt lists, and these packages,
# as far as this machine lacks them; nothing when it lacks nothing.
install_packages()
{
  local package
  local missing=()
  while read -r package; do
    case "$package" in
      "" | "#"*) continue ;;
    esac
    if [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" != installed ]; then
      missing+=("$package")
    fi
  done < <(cat cmake/debian-packages.txt; printf '%s\n' "$@")
  if [ "${#missing[@]}" -eq 0 ]; then
    return
  fi

  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo > /dev/null; then
      echo "These packages are missing, and there is no sudo to install them: ${missing[*]}" >&2
      return 1
    fi
    as_root=(sudo)
  fi
  echo "Installing ${#missing[@]} packages: ${missing[*]}"
  "${as_root[@]}" apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -qq --yes --no-install-recommends -o Dpkg::Use-Pty=0 "${missing[@]}" > /dev/null
}

# build_gnomon: builds the library and the program `gnomon` in build/release, and shows
# how far it is: one line on a terminal, elsewhere a line for every tenth.
build_gnomon()
{
  mkdir -p build
  cmake --preset release > build/configure.log || {
    cat build/configure.log >&2
    return 1
  }
  local compile=(env "NINJA_STATUS=[%f/%t, %e s] " cmake --build --preset release --target gnomon)
  if [ -t 1 ]; then
    "${compile[@]}"
    return
  fi
  local line tenth shown=0
  "${compile[@]}" | while IFS= read -r line; do
    if [[ "$line" =~ ^\[([0-9]+)/([0-9]+), ]]; then
      tenth=$((10 * BASH_REMATCH[1] / BASH_REMATCH[2]))
      if [ "$tenth" -eq "$shown" ]; then
        continue
      fi
      shown=$tenth
    fi
    printf '%s\n' "$line"
  done
}
