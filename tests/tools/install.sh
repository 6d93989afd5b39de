#!/usr/bin/env bash
# install.sh BUILD CMAKE COMPILER [FLAG...]: installs a build into an empty folder; there the program must find its library of
# models, and another CMake project must build on librheonet, with a component of its own.
set -euo pipefail
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
build=$1 cmake=$2 compiler=$3
shift 3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

"$cmake" --install "$build" --prefix "$folder/prefix" >"$folder/install.log"

# The licence of rheonet is installed, and the licences of the packages in the web pages, if these were built.
documents=$folder/prefix/share/doc/rheonet
cmp "$source/LICENSE" "$documents/LICENSE"
if [ -s "$build/tools/web/report.html" ]; then
  grep -q 'SIL OPEN FONT LICENSE' "$documents/NOTICE"
  grep -q '"bomFormat": "CycloneDX"' "$documents/sbom.cdx.json"
  # Each package that is listed has its licence, with a copyright.
  for package in $(sed -n 's/^ *"name": "\([^"]*\)",$/\1/p' "$documents/sbom.cdx.json" | grep -Ev '^rheonet$|\.woff2$'); do
    licence=$(sed -n "/^$(printf %s "$package" | sed 's,/,\\/,g') [0-9.]* (/,/^----/p" "$documents/NOTICE")
    grep -iq copyright <<<"$licence" || { echo "no licence of $package"; exit 1; }
  done
fi

# An empty entry in a path of libraries is the folder in which the program is called.
searched_by() { readelf -d "$1" | sed -n 's/.*Library r.*path: \[\(.*\)\]/\1/p'; }
[[ $(searched_by "$folder/prefix/bin/rheonet") == *lib* ]]
for file in "$build"/bin/* "$build"/lib/*.so "$folder"/prefix/bin/* "$folder"/prefix/lib/*/*.so*; do
  [[ -f $file ]] || continue
  path=$(searched_by "$file")
  case ":$path:" in ::) ;; *::*) echo "$file searches the current folder for libraries: $path"; exit 1 ;; esac
done

mkdir "$folder/user"
cd "$folder/user"
# A model that only the installed library has tells it from that of the source tree.
cat >>"$folder/prefix/share/rheonet/netlists/library/rheology.toml" <<'TOML'

[models.only_installed]
ports = ["a", "b"]
[models.only_installed.elements]
c1 = { type = "dashpot", between = ["a", "b"], damping = 1 }
TOML
cat >scene.toml <<'TOML'
include = ["library/rheology.toml"]
[elements]
drive = { type = "motion", at = "a", velocity = 1 }
m1 = { type = "only_installed", between = ["a", "ground"] }
[simulate]
stop = 1
output = { points = 3 }
TOML
env -u RHEONET_LIBRARY "$folder/prefix/bin/rheonet" run -q scene.toml >/dev/null
# So does the Python package.
packages=$folder/prefix/lib/python3/dist-packages
if [ -d "$packages/rheonet" ]; then
  env -u RHEONET_LIBRARY PYTHONPATH="$packages" /usr/bin/python3 -c 'import rheonet; assert len(rheonet.load("scene.toml").run().time) == 3'
fi
"$folder/prefix/bin/rheonet-serve" serve --help >/dev/null  # it finds its libraries, and is found:
"$folder/prefix/bin/rheonet" serve "$folder/none" 2>serve.log && exit 1
grep -Eq 'cannot serve|its web pages are missing' serve.log || { cat serve.log; exit 1; }

cat >CMakeLists.txt <<'CMAKE'
cmake_minimum_required(VERSION 3.25)
project(user LANGUAGES CXX)
find_package(rheonet 0.1 REQUIRED)
add_executable(user user.cpp cubic.cpp headers.cpp)
target_link_libraries(user PRIVATE rheonet::rheonet)
CMAKE
# The component is the example of components/README.md.
sed -n '/^```cpp$/,/^```$/p' "$source/components/README.md" | sed '/^```/d' >cubic.cpp
# Every header that is installed must find those that it needs.
(cd "$folder/prefix/include/rheonet" && find . -name '*.hpp' -printf '#include "%P"\n') | sort >headers.cpp
cat >user.cpp <<'CPP'
#include <cstdio>

#include "core/netlist/read.hpp"
#include "core/network/component.hpp"
#include "core/result/run.hpp"

int main() {
  const rheonet::ReadResult read = rheonet::read_scene_text(R"([elements]
drive = { type = "motion", at = "a", velocity = 2 }
k1 = { type = "cubic", between = ["a", "ground"], hardening = 3 }
[simulate]
stop = 1
output = { points = 2 }
record = ["k1.force"]
)", "text", ".", rheonet::declarations());
  for (const rheonet::Diagnostic& d : read.diagnostics) std::puts(rheonet::format(d, read.sources).c_str());
  if (!read.scene) return 1;
  rheonet::run(*read.scene, {.csv = stdout});
}
CPP
# The generator of the build itself: a bare machine need not have another.
generator=$(sed -n 's/^CMAKE_GENERATOR:INTERNAL=//p' "$build/CMakeCache.txt")
"$cmake" -G "$generator" -S . -B build -DCMAKE_PREFIX_PATH="$folder/prefix" -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_CXX_FLAGS="$*" \
  -DCMAKE_BUILD_TYPE=Debug >build.log 2>&1 || { cat build.log; exit 1; }
"$cmake" --build build >>build.log 2>&1 || { cat build.log; exit 1; }
build/user >rows.csv || { cat rows.csv; exit 1; }
grep -Eq '^1,(24|23\.9999|24\.0000)' rows.csv || { cat rows.csv; exit 1; }  # 3 (2 m)^3 = 24 N
echo "installed, found and used"
