#!/usr/bin/env bash
# run.sh SITE NODE TEST: runs a test of the site. Exit status 77, which skips it, where the site could not be built.
[ -e "$1/rheonet.html" ] || {
  echo "the site is not built: the sources of the solvers, or npm's packages, could not be fetched"
  exit 77
}
exec "$2" --test "$3"
