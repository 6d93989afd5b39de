#!/usr/bin/env bash
# build.sh BUILD WEB OUTPUT VERSION IDA_INCLUDE CCACHE UNIT_TABLE PROGRAM: compiles rheonet to WebAssembly in BUILD and puts the site together in OUTPUT, of
# the pages that are bundled in WEB. Where the sources of the solvers cannot be fetched, or there are no pages, it says so and makes
# no site, so that all else builds. CCACHE is the compiler cache, or "";
# UNIT_TABLE the program that writes the table of units, PROGRAM rheonet itself, which writes the JSON Schema.
set -euo pipefail
source=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=$1 web=$2 output=$3 version=$4 ida=$5 ccache=$6 unit_table=$7 program=$8

without_site() {
  echo "warning: the site is not built: $1" >&2
  exit 0
}

[ -s "$web/playground.js" ] || without_site "the web pages are missing"
mkdir -p "$build"
"$source/fetch_sources.sh" "$build/sources" >"$build/fetch.log" 2>&1 ||
  without_site "the sources of SUNDIALS and SuiteSparse cannot be fetched (log: $build/fetch.log)"

export NODE_PATH=${NODE_PATH:-/usr/share/nodejs} # Debian's emscripten finds its packages there
emscripten=$(dirname "$(readlink -f "$(command -v em++)")")
generator=()
if command -v ninja >/dev/null; then generator=(-G Ninja); fi
cmake -S "$source" -B "$build/wasm" "${generator[@]}" -DCMAKE_BUILD_TYPE= \
  -DCMAKE_TOOLCHAIN_FILE="$emscripten/cmake/Modules/Platform/Emscripten.cmake" \
  -DCMAKE_C_COMPILER_LAUNCHER="$ccache" -DCMAKE_CXX_COMPILER_LAUNCHER="$ccache" \
  -DSUNDIALS_SOURCE="$build/sources/sundials" -DSUITESPARSE_SOURCE="$build/sources/suitesparse" -DIDA_INCLUDE="$ida" -DVERSION="$version" \
  >"$build/configure.log" 2>&1 || {
  cat "$build/configure.log" >&2
  exit 1
}
cmake --build "$build/wasm" --parallel "$(nproc)" >"$build/build.log" 2>&1 || {
  grep -E -A5 "error|FAILED" "$build/build.log" >&2
  exit 1
}
"$unit_table" >"$build/units.txt"
"$program" schema >"$build/schema.json"
node "$source/pack.mjs" "$web" "$build" "$source/../../netlists" "$output"
