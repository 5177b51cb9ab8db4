# Set-up on Debian 12, shared by examples/bunny.sh and tests/run.sh, which source it.

# install_packages [PACKAGE...]: installs what cmake/debian-packages.txt lists, and these packages, as far as this machine lacks
# them; nothing when it lacks nothing.
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

# build PRESET: configures and builds one of CMakePresets.json, in build/PRESET.
build()
{
  cmake --preset "$1"
  cmake --build --preset "$1"
}
