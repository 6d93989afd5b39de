#!/usr/bin/env bash
# tuned_numbers.sh SOURCE: every tuned number of the engine stands in core/base/numerics.def.
#
# Refuses, in the folders of the engine, constants with a number as their value, and literals with an exponent or a decimal
# fraction. Numbers of mathematics and sizes that an algorithm fixes are listed below.
set -euo pipefail
cd "$1"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# FILE NAME for constants, FILE LITERAL for literals.
allowed='
core/dae/consistency.hpp kinds
core/dae/consistency.cpp velocity
core/dae/polynomial.hpp step_points
core/network/series_parallel_reduction.cpp spring
core/result/claims.cpp lobatto_weights
core/result/csv.cpp full
core/result/energy.cpp points
core/result/energy.cpp abscissae
core/result/energy.cpp weights
core/result/energy.hpp remembered
core/result/sensitivities.cpp farthest
core/result/row_store.cpp memory
core/result/row_store.cpp smallest_block
core/solve/events.hpp of_slider
core/solve/integrator.hpp highest_order
core/solve/vectors.cpp block
core/dae/sliding_mode.cpp 0.5
core/result/energy.cpp 0.12948496616886969
core/result/energy.cpp 0.27970539148927664
core/result/energy.cpp 0.33998104358485626
core/result/energy.cpp 0.38183005050511894
core/result/energy.cpp 0.40584515137739717
core/result/energy.cpp 0.41795918367346939
core/result/energy.cpp 0.74153118559939444
core/result/energy.cpp 0.94910791234275852
core/result/energy.cpp 0.86113631159405258
core/result/energy.cpp 0.65214515486254614
core/result/energy.cpp 0.34785484513745386
core/result/cpu_time.hpp 1e-9
core/result/reference_solution.hpp 1e-6
core/result/work_precision.hpp 1e-6
core/result/work_precision.cpp 0.5
core/solve/simulation.hpp 1e-6
core/solve/stopping.cpp 0.5
'

# Prints FILE NAME for each constant, and FILE LITERAL for each literal, of these files.
numbers() {
  awk '{ sub(/\/\/.*/, ""); gsub(/"([^"\\]|\\.)*"/, "\"\""); line = $0 }
       match($0, /constexpr (double|float|int|long|unsigned|auto|std::size_t|Eigen::Index|sunindextype|std::array)[^=(;]*(= *-?[0-9.]|= *\{|\{[-0-9.])/) {
         name = substr($0, RSTART, RLENGTH)
         sub(/ *(=|\{[-0-9.]).*/, "", name)
         sub(/.*[ >]/, "", name)
         sub(/\[.*/, "", name)
         print FILENAME, name
       }
       { while (match($0, /(^|[^A-Za-z_0-9.])([0-9]+(\.[0-9]*)?[eE]-?[0-9]+|[0-9]*\.[0-9]*[1-9][0-9]*)/)) {
           literal = substr($0, RSTART, RLENGTH)
           sub(/^[^0-9.]/, "", literal)
           rest = substr($0, RSTART + RLENGTH)
           print FILENAME, literal
           $0 = rest
         } }
       match(line, /[0-9]+ \* std::numeric_limits<double>::epsilon/) { print FILENAME, substr(line, RSTART, RLENGTH) }' "$@"
}

new() { numbers "$@" | sort -u | grep -vxF "$allowed" || true; }

failed=0
new core/{dae,solve,nonsmooth,network,result}/*.[ch]pp >"$folder/log"
if [ -s "$folder/log" ]; then
  echo "tuned numbers outside core/base/numerics.def:"
  sed 's/^/  /' "$folder/log"
  failed=1
fi

# Every number of the list has a use.
sed -nE 's/^NUMBER\([^,]*, ([a-z_]+),.*/\1/p; s/^NUMBERS\(([a-z_]+),.*/\1/p' core/base/numerics.def | sort >"$folder/listed"
grep -ohE 'numerics::[a-z_]+' -r core | sed 's/.*:://' | sort -u >"$folder/used"
comm -23 "$folder/listed" "$folder/used" >"$folder/log"
if [ ! -s "$folder/listed" ] || [ -s "$folder/log" ]; then
  echo "numbers that nothing uses:"
  sed 's/^/  /' "$folder/log"
  failed=1
fi

# Planted numbers of each kind must be found, and mathematics must not.
cat >"$folder/planted.cpp" <<'CODE'
constexpr double share = 1e-3;
  static constexpr int most{7};
constexpr double several[] = {1, 2};
if (x > 0.9 * y) z = 3e5;  // 0.8 in a comment, and constexpr int none = 5;
z = 4 * std::numeric_limits<double>::epsilon();
constexpr double never = std::numeric_limits<double>::infinity();
constexpr double grains = numerics::sum_ulps * std::numeric_limits<double>::epsilon();
const double half = (a + b) / 2 * 1.0, text = f("0.7");
CODE
found=$(numbers "$folder/planted.cpp" | sed 's/[^ ]* //' | paste -sd ' ')
[ "$found" = "share 1e-3 most several 0.9 3e5 4 * std::numeric_limits<double>::epsilon" ] || { echo "planted numbers: found $found"; failed=1; }
exit "$failed"
