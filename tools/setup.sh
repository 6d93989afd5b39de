# Read by tools/demo and tools/test: installs what is missing, configures and builds, in the project's folder.

say() { printf '\n== %s\n' "$*"; }

# Runs a command as root: directly, or through sudo.
as_root() {
  if [ "$(id -u)" -eq 0 ]; then "$@"; else sudo "$@"; fi
}

apt_install() {
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends \
    -o Acquire::Retries=3 -o Dpkg::Use-Pty=0 "$@"
}

install_packages() {
  local log=build/packages.log package
  local missing=()
  while read -r package; do
    # A Node.js from elsewhere brings its own npm, with which Debian's cannot be installed.
    if [ "$package" = npm ] && command -v npm >/dev/null; then continue; fi
    [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || missing+=("$package")
  done < <(grep -v '^#' tools/packages)
  if [ ${#missing[@]} -eq 0 ]; then
    say "Debian packages: all there"
    return
  fi
  if ! command -v apt-get >/dev/null || { [ "$(id -u)" -ne 0 ] && ! command -v sudo >/dev/null; }; then
    say "Debian packages are missing, and only root may install them. As root, run:"
    echo "apt-get update && apt-get install --no-install-recommends ${missing[*]}"
    exit 1
  fi
  say "Debian packages: installing ${missing[*]}"
  echo "   and what they need: some minutes and about 2 GB on a bare machine (log: $log)"
  mkdir -p build
  # The lists of packages are fetched only if apt does not know the packages, or its lists name files that are gone.
  if ! { apt-get install --simulate --no-install-recommends "${missing[@]}" && apt_install "${missing[@]}"; } \
    >"$log" 2>&1; then
    echo "   fetching the lists of packages"
    if ! { as_root apt-get update && apt_install "${missing[@]}"; } >"$log" 2>&1; then
      tail -n 20 "$log" >&2
      say "Installing the packages failed; the log is $log" >&2
      exit 1
    fi
  fi
}

# build TARGET: an optimised build in build/release.
build() {
  say "Configuring in build/release (log: build/configure.log)"
  local generator=()
  if [ ! -e build/release/CMakeCache.txt ] && command -v ninja >/dev/null; then generator=(-G Ninja); fi
  mkdir -p build
  cmake --preset release "${generator[@]}" >build/configure.log 2>&1 || {
    cat build/configure.log >&2
    exit 1
  }
  say "Building $1"
  cmake --build --preset release --target "$1" --parallel "$(nproc)"
}
