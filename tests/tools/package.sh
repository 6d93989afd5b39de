#!/usr/bin/env bash
# package.sh [--only-fields] PACKAGE, or package.sh [--only-fields] CPACK CONFIG, which makes the package: a Debian package of
# rheonet depends on libraries alone, and installed in a bare Debian it runs. It exits with 77 (skipped) where debootstrap is
# missing, or when root does not run it.
set -euo pipefail
folder=$(mktemp -d)
finish() {
  if mountpoint -q "$folder/root/proc"; then umount "$folder/root/proc"; fi
  rm -rf --one-file-system "$folder"
}
trap finish EXIT
skip() { echo "skipped: $1"; exit 77; }

only_fields=no
if [ "$1" = --only-fields ]; then only_fields=yes; shift; fi
if [ $# -eq 2 ]; then
  for tool in dpkg-shlibdeps file; do command -v "$tool" >/dev/null || skip "$tool is missing (Debian: dpkg-dev, file)"; done
  "$1" --config "$2" -B "$folder/package" >"$folder/log" 2>&1 || { cat "$folder/log"; exit 1; }
  package=$(echo "$folder"/package/*.deb)
else
  package=$1
fi
# Libraries, whose packages begin with `lib` but for zlib1g: no headers, no programs, nothing of MPI or PETSc.
depends=$(dpkg-deb --field "$package" Depends)
echo "depends on $depends"
if tr ',' '\n' <<<"$depends" | sed 's/^ *//; s/ .*//' | grep -vE '^(lib[a-z0-9.+-]*|zlib1g)$' || grep -E -- '-dev|mpi|petsc' <<<"$depends"; then
  echo "these are not libraries"
  exit 1
fi

[ "$only_fields" = no ] || exit 0
[ "$(id -u)" -eq 0 ] || skip "only root makes a bare Debian"
command -v debootstrap >/dev/null || skip "debootstrap is missing (Debian: debootstrap)"
# From where this machine has its own packages.
mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Identifier: Packages' | sed -n 1p)
suite=$(. /etc/os-release && echo "$VERSION_CODENAME")
debootstrap --variant=minbase "$suite" "$folder/root" ${mirror:+"$mirror"} >"$folder/log" 2>&1 || { tail "$folder/log"; exit 1; }
mount -t proc proc "$folder/root/proc" 2>"$folder/log" || skip "/proc cannot be mounted"  # by which the program finds its library
cp "$package" "$folder/root/rheonet.deb"
chroot "$folder/root" env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends ./rheonet.deb >"$folder/log" 2>&1 ||
  { tail "$folder/log"; exit 1; }
chroot "$folder/root" sh -ec '
  rheonet --version
  rheonet run -q /usr/share/rheonet/netlists/thesis/viscometer.toml -o rows.csv --plot picture.svg  # its claims hold, or it fails
  rheonet serve --help >/dev/null
  rheonet-serve serve --help >/dev/null'
[ "$(wc -l <"$folder/root/rows.csv")" -eq 1002 ] || { echo "expected 1001 rows"; exit 1; }
grep -q '<svg' "$folder/root/picture.svg" || { echo "expected a picture"; exit 1; }
chroot "$folder/root" apt-get remove -y rheonet >"$folder/log" 2>&1 || { tail "$folder/log"; exit 1; }
[ ! -e "$folder/root/usr/bin/rheonet" ] || { echo "the program stays when the package is removed"; exit 1; }
echo "installed, run and removed in a bare Debian"
