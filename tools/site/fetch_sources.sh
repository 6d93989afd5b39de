#!/usr/bin/env bash
# fetch_sources.sh FOLDER: downloads the sources of the solvers from apt's server and unpacks them in FOLDER as sundials/ and
# suitesparse/. Existing folders are not fetched again.
set -euo pipefail
folder=$1

# Arguments: PACKAGE of the library, ARCHIVE of its source, SHA256 of the archive, NAME of the folder, paths to unpack.
fetch() {
  local package=$1 archive=$2 sum=$3 name=$4
  shift 4
  if [ -e "$folder/$name/.$sum" ]; then return; fi
  local address
  address=$(apt-get download --print-uris "$package" | sed -n "s/^'\([^']*\)\/[^/']*'.*/\1/p" | sed -n 1p)
  if [ -z "$address" ]; then
    echo "apt does not know the package $package" >&2
    return 1
  fi
  rm -rf "${folder:?}/$name"
  mkdir -p "$folder/$name"
  /usr/lib/apt/apt-helper -o Acquire::Retries=3 download-file "$address/${archive//+/%2b}" "$folder/$archive" "SHA256:$sum" >/dev/null
  tar -xf "$folder/$archive" -C "$folder/$name" --strip-components=1 --wildcards "$@"
  rm "$folder/$archive"
  touch "$folder/$name/.$sum"
}

mkdir -p "$folder"
fetch libsundials-dev sundials_6.4.1+dfsg1.orig.tar.xz \
  c61157f1d4be06c704bea40cb131eb63ba2dada161989071604d0a0959cdf04a sundials '*/include' '*/src' '*/LICENSE'
fetch libsuitesparse-dev suitesparse_5.12.0+dfsg.orig.tar.xz \
  bb106c43049138c19675cd70322e72ff8e4fd8bdcab3a096307fd78488913faf suitesparse '*/AMD' '*/BTF' '*/COLAMD' '*/KLU' '*/SuiteSparse_config' '*/LICENSE.txt'
