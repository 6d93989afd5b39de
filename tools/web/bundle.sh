#!/usr/bin/env bash
# bundle.sh OUTPUT VERSION NODE NPM: installs the packages that package-lock.json names into OUTPUT and bundles what the browser gets there.
# Where that cannot be done OUTPUT gets empty files, so that all else builds; they are older than all sources, so that the
# next build tries again.
set -uo pipefail
source=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
output=$1 version=$2 node=$3 npm=$4
files=(report.html playground.html playground.css playground.js playground.css.gz playground.js.gz token.html NOTICE sbom.cdx.json)

install() {
  cmp -s "$source/package-lock.json" "$output/installed.json" && return
  rm -f "$output/installed.json"
  cp "$source/package.json" "$source/package-lock.json" "$output/"
  (cd "$output" && "$npm" ci --ignore-scripts --no-audit --no-fund --loglevel=error) || return
  cp "$source/package-lock.json" "$output/installed.json"
}

mkdir -p "$output"
if ! { install && "$node" "$source/build.mjs" "$output" "$version"; } >"$output/bundle.log" 2>&1; then
  tail -n 15 "$output/bundle.log" >&2
  echo "warning: the web pages could not be built (log: $output/bundle.log); \`rheonet report\` and \`serve\` will say so" >&2
  for file in "${files[@]}"; do
    : >"$output/$file"
    touch -d @0 "$output/$file"
  done
fi
