#!/usr/bin/env bash
# c_interface.sh CMAKE GENERATOR SOURCE BUILD FOLDER: installs BUILD into FOLDER; libmimicry shows the functions of
# mimicry.h and no others, and the programs of docs/c-abi.md run with it.
set -euo pipefail
cmake=$1 generator=$2 source=$3 build=$4 folder=$5
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
# shellcheck source=tests/install/programs.sh
. "$here/programs.sh"
rm -rf "$folder"
mkdir -p "$folder"
"$cmake" --install "$build" --prefix "$folder/prefix" >/dev/null
library=$(find "$folder/prefix" -name libmimicry.so)
pkg=$(dirname "$(find "$folder/prefix" -name mimicry-c.pc)")

nm --dynamic --defined-only "$library" | awk '{print $3}' | sort >"$folder/exported"
grep -o '\bmimicry_[a-z_]*(' "$folder/prefix/include/mimicry/mimicry.h" | tr -d '(' | sort -u >"$folder/declared"
diff "$folder/declared" "$folder/exported"

program_of c "$source/docs/c-abi.md" >"$folder/draw.c"
program_of python "$source/docs/c-abi.md" >"$folder/draw.py"
# shellcheck disable=SC2046
cc -std=c99 -Wall -Wextra -Wpedantic -Werror "$folder/draw.c" \
  $(PKG_CONFIG_PATH="$pkg" pkg-config --cflags --libs mimicry-c) -Wl,-rpath,"$(dirname "$library")" -o "$folder/draw"
"$folder/draw" | tee "$folder/c.txt"
grep -q '^90 points' "$folder/c.txt"
python3 "$folder/draw.py" "$library" 2>"$folder/error.txt" | diff "$folder/c.txt" -
grep -q teapot "$folder/error.txt"

# The same through CMake.
cat >"$folder/CMakeLists.txt" <<'CMAKE'
cmake_minimum_required(VERSION 3.25)
project(app C CXX)
find_package(mimicry REQUIRED)
add_executable(by_cmake draw.c)
target_link_libraries(by_cmake PRIVATE mimicry::c)
CMAKE
"$cmake" -S "$folder" -B "$folder/build" -G "$generator" -DCMAKE_PREFIX_PATH="$folder/prefix" >/dev/null
"$cmake" --build "$folder/build" >/dev/null
"$folder/build/by_cmake" | diff "$folder/c.txt" -
