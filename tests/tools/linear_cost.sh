#!/usr/bin/env bash
# The cost of a step is proportional to the size of the network: in a chain four times as long, the instructions per mass and step are equal
# within a quarter. valgrind counts them. One chain has springs and dashpots only, one has friction, and so events.
#
#   linear_cost.sh VALGRIND RHEONET
set -eu
valgrind=$1
rheonet=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

# A chain of $1 masses that ends at the ground, over the time $2 [s], with the elements $3 between one and the next. `A` and `B` stand for these.
scene() {
  echo '[elements]'
  echo 'drive = { type = "motion", at = "n0", velocity = { sine = "0.3 m/s", frequency = "1.3 Hz" } }'
  for ((i = 1; i <= $1; ++i)); do
    echo "$3" | sed "s/A/n$((i - 1))/; s/B/n$i/; s/^[a-z]*/&$i/"
    echo "m$i = { type = \"mass\", at = \"n$i\", mass = 0.07 }"
  done
  echo "[simulate]
stop = $2
output = { points = 2 }
record = [\"n1.velocity\"]"
}

# Instructions a step and mass.
cost() {
  scene "$1" "$2" "$3" > scene.toml
  "$valgrind" --tool=callgrind --callgrind-out-file=/dev/null "$rheonet" run scene.toml -o rows.csv > log.txt 2>&1 || { cat log.txt >&2; exit 1; }
  scene "$1" 1e-12 "$3" > scene.toml
  "$valgrind" --tool=callgrind --callgrind-out-file=/dev/null "$rheonet" run scene.toml -o rows.csv > start.txt 2>&1 || { cat start.txt >&2; exit 1; }
  local all begin steps
  all=$(sed -n 's/.*Collected : *//p' log.txt)
  begin=$(sed -n 's/.*Collected : *//p' start.txt)
  steps=$(sed -n 's/^ *steps *\([0-9,]*\).*/\1/p' log.txt | tr -d ,)
  echo $(((all - begin) / (steps * $1)))
}

failed=0
# Name, number of masses, time, elements.
check() {
  local short long
  short=$(cost "$2" "$3" "$4")
  long=$(cost $((4 * $2)) "$3" "$4")
  awk -v name="$1" -v short="$short" -v long="$long" 'BEGIN {
    ratio = long / short
    printf "%-24s %12d %12d %8.3f\n", name, short, long, ratio
    exit ratio < 1.25 ? 0 : 1
  }' || failed=1
}

ends='between = ["A", "B"]'
printf '%-24s %12s %12s %8s\n' chain short 'four times' ratio
check 'springs and dashpots' 75 0.05 "k = { type = \"spring\", $ends, stiffness = 1100 }
c = { type = \"dashpot\", $ends, damping = 1.3 }"
check friction 40 0.1 "k = { type = \"spring\", $ends, stiffness = 1100 }
f = { type = \"sfm\", $ends, stiffness = 530, coulomb = 0.7, exponent = 1 }"
exit $failed
