#!/usr/bin/env bash
# valgrind.sh VALGRIND RHEONET: memcheck finds no error and no leak in a few scenes, nor where there are mistakes to report.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
netlists=$here/../../netlists
valgrind=$1 rheonet=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

memcheck() {
  local expected=$1 status=0
  shift
  "$valgrind" --quiet --leak-check=full --show-leak-kinds=definite --errors-for-leak-kinds=definite --error-exitcode=99 --suppressions="$here/valgrind.supp" "$rheonet" "$@" \
    >"$folder/out" 2>"$folder/err" || status=$?
  if [ "$status" -ne "$expected" ]; then
    cat "$folder/err"
    echo "rheonet $*: exit status $status in place of $expected"
    exit 1
  fi
}

for scene in teaching/relaxation thesis/sfm-loops thesis/viscometer; do
  memcheck 0 run "$netlists/$scene.toml" -o "$folder/rows.csv"
done
memcheck 0 compare "$netlists/thesis/compare/vfm.toml" "$netlists/thesis/compare/maxwell.toml" -o "$folder/rows.csv"
memcheck 0 run "$netlists/thesis/compare/bingham-by-nodes.toml" -o "$folder/rows.csv"
memcheck 0 run "$netlists/teaching/relaxation.toml" --certify --accuracy 1e-8 --profile -o "$folder/rows.csv" --events "$folder/events.csv"
memcheck 0 precision "$netlists/teaching/relaxation.toml" --accuracies 1e-2,1e-4 --runs 1 -o "$folder/rows.csv" --plot "$folder/prices.svg"
memcheck 0 check -v "$netlists/teaching/creep.toml"
memcheck 2 check "$netlists/teaching/creep.toml" --set maxwell.stifness=3 --set simulate.stop='"3 kg"'
echo "no error, no leak"
