#!/usr/bin/env bash
# readme_program.sh CMAKE SOURCE BUILD FOLDER: installs BUILD into FOLDER, takes the first C++ program out
# of the README, builds it against the installed tree in both ways and runs it.
set -euo pipefail
cmake=$1 source=$2 build=$3 folder=$4
rm -rf "$folder"
mkdir -p "$folder/app"
"$cmake" --install "$build" --prefix "$folder/prefix" >/dev/null
"$folder/prefix/bin/mimicry" --version

sed -n '/^```cpp$/,/^```$/p' "$source/README.md" | sed '1d;/^```$/,$d' >"$folder/app/main.cpp"
cat >"$folder/app/CMakeLists.txt" <<'CMAKE'
cmake_minimum_required(VERSION 3.25)
project(app CXX)
find_package(mimicry REQUIRED)
add_executable(app main.cpp)
target_link_libraries(app PRIVATE mimicry::mimicry mimicry::io)
CMAKE
"$cmake" -S "$folder/app" -B "$folder/app/build" -G Ninja -DCMAKE_PREFIX_PATH="$folder/prefix" >/dev/null
"$cmake" --build "$folder/app/build" >/dev/null
"$folder/app/build/app" | tee "$folder/cmake.txt"

pkg=$(dirname "$(find "$folder/prefix" -name mimicry.pc)")
# shellcheck disable=SC2046
c++ -std=c++20 "$folder/app/main.cpp" $(PKG_CONFIG_PATH="$pkg" pkg-config --cflags --libs mimicry) -o "$folder/app/by_pkg_config"
"$folder/app/by_pkg_config" | cmp - "$folder/cmake.txt"
grep -q '^90 points' "$folder/cmake.txt"
