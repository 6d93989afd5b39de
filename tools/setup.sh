# Read by tools/demo, tools/test and tools/package: installs what is missing, configures and builds, in the project's folder.

say() { printf '\n== %s\n' "$*"; }

# Runs a command as root: directly, or through sudo.
as_root() {
  if [ "$(id -u)" -eq 0 ]; then "$@"; else sudo "$@"; fi
}

# with_lists COMMAND...: fetches apt's lists of packages only if the command fails without: apt does not know the packages, or
# its lists name files that are gone.
with_lists() {
  local log=build/packages.log
  mkdir -p build
  "$@" >"$log" 2>&1 && return
  echo "   fetching the lists of packages"
  { as_root apt-get update && "$@"; } >"$log" 2>&1 && return
  tail -n 20 "$log" >&2
  say "Installing packages failed; the log is $log" >&2
  exit 1
}

apt_install() {
  apt-get install --simulate --no-install-recommends "$@" &&
    as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends \
      -o Acquire::Retries=3 -o Dpkg::Use-Pty=0 "$@"
}

# install_packages LIST...: the packages of tools/packages/LIST.
install_packages() {
  local package missing=()
  while read -r package; do
    # A Node.js from elsewhere brings its own npm, with which Debian's cannot be installed.
    if [ "$package" = npm ] && command -v npm >/dev/null; then continue; fi
    [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || missing+=("$package")
  done < <(cd tools/packages && grep -hv '^#' "$@")
  if [ ${#missing[@]} -eq 0 ]; then
    say "Debian packages: all there"
  else
    if ! command -v apt-get >/dev/null || { [ "$(id -u)" -ne 0 ] && ! command -v sudo >/dev/null; }; then
      say "Debian packages are missing, and only root may install them. As root, run:"
      echo "apt-get update && apt-get install --no-install-recommends ${missing[*]}"
      exit 1
    fi
    say "Debian packages: installing ${missing[*]}"
    echo "   and the packages that they depend on (log: build/packages.log)"
    with_lists apt_install "${missing[@]}"
  fi
  unpack_sundials_headers
}

# Debian's libsundials-dev depends on MPI, PETSc and Fortran (2 GB, half a minute), of which IDA needs nothing: only the
# headers are taken from it, into build/sundials, where CMakeLists.txt looks for them.
unpack_sundials_headers() {
  local folder=build/sundials
  if [ -e /usr/include/ida/ida.h ] || [ -e "$folder/usr/include/ida/ida.h" ]; then return; fi
  say "Headers of SUNDIALS: unpacking them in $folder"
  rm -rf "$folder"
  mkdir -p "$folder"
  with_lists download "$folder" libsundials-dev
  dpkg-deb --fsys-tarfile "$folder"/libsundials-dev_*.deb | tar -x -C "$folder" ./usr/include
}

download() { (cd "$1" && apt-get download -o Acquire::Retries=3 "$2"); }

# build TARGET...: an optimised build in build/release.
build() {
  say "Configuring in build/release (log: build/configure.log)"
  local generator=()
  if [ ! -e build/release/CMakeCache.txt ] && command -v ninja >/dev/null; then generator=(-G Ninja); fi
  mkdir -p build
  cmake --preset release "${generator[@]}" >build/configure.log 2>&1 || {
    cat build/configure.log >&2
    exit 1
  }
  say "Building $*"
  cmake --build --preset release --target "$@" --parallel "$(nproc)"
}
