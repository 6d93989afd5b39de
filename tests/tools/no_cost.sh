#!/usr/bin/env bash
# An effect that is not called for costs nothing: of each pair of scenes one has an element that could bring an effect and does
# not, the other is written without it. Both must take the same number of instructions within 1 %, which valgrind counts.
#
#   no_cost.sh VALGRIND RHEONET
set -eu
valgrind=$1
rheonet=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

# A scene with the given elements beside a driven mass on a spring and a dashpot.
scene() {
  cat <<SCENE
[elements]
drive = { type = "motion", at = "hand", velocity = { sine = "0.3 m/s", frequency = "1.3 Hz" } }
k1 = { type = "spring", between = ["hand", "cart"], stiffness = 90 }
m1 = { type = "mass", at = "cart", mass = 0.7 }
c1 = { type = "dashpot", between = ["cart", "ground"], damping = 2 }
$1
[simulate]
stop = 60
output = { points = 11 }
record = ["cart.velocity", "k1.force"]
SCENE
}

instructions() {
  scene "$1" > scene.toml
  "$valgrind" --tool=callgrind --callgrind-out-file=/dev/null "$rheonet" run scene.toml -q -o rows.csv 2> log.txt || { cat log.txt >&2; exit 1; }
  sed -n 's/.*Collected : *//p' log.txt
}

failed=0
check() {
  local could is
  could=$(instructions "$2")
  is=$(instructions "$3")
  awk -v name="$1" -v could="$could" -v is="$is" 'BEGIN {
    ratio = could / is
    printf "%-24s %12d %12d %8.4f\n", name, could, is, ratio
    exit ratio > 0.99 && ratio < 1.01 ? 0 : 1
  }' || failed=1
}

on_cart='between = ["cart", "ground"]'
printf '%-24s %12s %12s %8s\n' effect "could have" "has not" ratio
check inertia        'x = { type = "mass", at = "cart", mass = 0 }' ''
check elasticity     "x = { type = \"vfm\", $on_cart, damping = 3, stiffness = \"inf\" }" "x = { type = \"dashpot\", $on_cart, damping = 3 }"
check viscosity      "x = { type = \"dashpot\", $on_cart, damping = 0 }" ''
check 'viscosity of a vfm' "x = { type = \"vfm\", $on_cart, damping = \"inf\", stiffness = 50 }" "x = { type = \"spring\", $on_cart, stiffness = 50 }"
check 'dry friction' "x = { type = \"slider\", $on_cart, coulomb = 0 }" ''
check 'its memory'   "x = { type = \"sfm\", $on_cart, stiffness = 70, coulomb = \"inf\" }" "x = { type = \"spring\", $on_cart, stiffness = 70 }"
check 'of a cfm'     "x = { type = \"cfm\", $on_cart, stiffness = 50, damping = 3, coulomb = \"inf\" }" "x = { type = \"vfm\", $on_cart, stiffness = 50, damping = 3 }"
check delay          "x = { type = \"vfm\", $on_cart, stiffness = 50, damping = 3, delay = 0 }" "x = { type = \"vfm\", $on_cart, stiffness = 50, damping = 3 }"
check feedback       'x = { type = "gain", in = "cart.velocity", gain = "3 N*s/m" }' ''
check 'a part by itself' 'x = { type = "mass", at = "bob", mass = 2 }
y = { type = "spring", between = ["bob", "ground"], stiffness = 300 }' ''
check 'a free end' 'x = { type = "cfm", between = ["cart", "loose"], stiffness = 50, damping = 3, coulomb = 2, exponent = 1 }' ''
exit $failed
