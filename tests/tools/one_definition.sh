#!/usr/bin/env bash
# one_definition.sh SOURCE LIBRARY PROGRAM COMPILER [FLAG...]: every name has one definition.
#
# Compilers and linkers overlook two types of one name in different sources, and two functions that differ in the type they
# return only (the names of those that return a std::string have a tag of their own). Both are undefined behaviour.
set -euo pipefail
source=$1 library=$2 program=$3
shift 3
compiler=$1
compile=("$@" -std=c++20 -fsyntax-only -x c++ -I . -)
cd "$source"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failed=0

# Read one after the other by one compiler, headers that define a name twice do not compile.
headers() { ls core/*/*.hpp components/*.hpp tools/{plot,draw,rheonet,report,serve,web}/*.hpp | sed 's/.*/#include "&"/'; }

# A type that a .cpp file has for itself stands in `namespace {`, where no other can see it.
types_outside() {
  awk 'FNR == 1 { own = 0 }
       /^namespace \{/ { own = 1 }
       /^\}  \/\/ namespace$/ { own = 0 }
       !own && /^((struct|class|enum class|enum|union) [A-Za-z_0-9]+ [^;]*\{|inline |template )/ { print FILENAME ":" FNR ": " $0 }' "$@"
}

# Global functions of which there are several once the tag of std::string is gone.
functions_twice() { nm --defined-only "$@" | awk '$2 == "T" { gsub(/B5cxx11/, "", $3); print $3 }' | sort | uniq -d | c++filt; }

report() { echo "$1:"; sed 's/^/  /'; failed=1; }

headers | "${compile[@]}" >"$folder/log" 2>&1 || report "two definitions in headers" <"$folder/log"
types_outside core/*/*.cpp components/*.cpp tools/{plot,draw,python,rheonet,report,serve}/*.cpp >"$folder/log"
[ ! -s "$folder/log" ] || report "definitions in a .cpp file that others could repeat (move them into \`namespace {\`, or into a header)" <"$folder/log"
functions_twice "$library" "$program" >"$folder/log"
[ ! -s "$folder/log" ] || report "functions that differ only in what they return" <"$folder/log"

# Planted faults of each kind must be found.
printf '#include "tools/rheonet/figure_file.hpp"\nnamespace rheonet::tool { struct RunFigure { int other; }; }\n' |
  "${compile[@]}" >"$folder/log" 2>&1 && failed=1
grep -q 'redefinition of .*RunFigure' "$folder/log" || { echo "a type defined twice is overlooked"; failed=1; }
printf 'namespace rheonet {\nnamespace {\nstruct Own {\n};\n}  // namespace\nstruct Shared {\n};\n}\n' >"$folder/planted.cpp"
[ "$(types_outside "$folder/planted.cpp")" = "$folder/planted.cpp:6: struct Shared {" ] || { echo "a type outside \`namespace {\` is overlooked"; failed=1; }
echo '#include <string>
namespace planted { std::string twice(int) { return {}; } }' >"$folder/one.cpp"
echo 'namespace planted { int twice(int) { return 0; } }' >"$folder/other.cpp"
for file in one other; do "$compiler" -c "$folder/$file.cpp" -o "$folder/$file.o"; done
[ "$(functions_twice "$folder/one.o" "$folder/other.o")" = "planted::twice(int)" ] || { echo "a function defined twice is overlooked"; failed=1; }
exit "$failed"
