#!/usr/bin/env bash
# subproject.sh CMAKE GENERATOR SOURCE FOLDER: a program of another project gets mimicry by add_subdirectory
# where all but Eigen and header-only libraries is hidden: library, io and C interface are built, and nothing
# else. The same build, shared, is installed as a distribution would: prefix /usr, a folder of libraries for
# the architecture, into a staging folder; from there it serves programs through pkg-config and CMake.
set -euo pipefail
cmake=$1 generator=$2 source=$3 folder=$4
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
# shellcheck source=tests/install/programs.sh
. "$here/programs.sh"
rm -rf "$folder/app" "$folder/stage" "$folder/user" "$folder/readme_cache"
mkdir -p "$folder/app" "$folder/user"

program_of cpp "$source/README.md" >"$folder/app/main.cpp"
program_of c "$source/docs/c-abi.md" >"$folder/app/draw.c"
cat >"$folder/app/CMakeLists.txt" <<CMAKE
cmake_minimum_required(VERSION 3.25)
project(app C CXX)
add_subdirectory("$source" mimicry)
add_executable(app main.cpp)
target_link_libraries(app PRIVATE mimicry::mimicry)
add_executable(draw draw.c)
target_link_libraries(draw PRIVATE mimicry::c)
CMAKE
hidden=()
for package in embree OpenSSL Boost CLI11 PNG PkgConfig GTest benchmark draco meshoptimizer; do
  hidden+=("-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON")
done
# One file per module, not optimised: this is about building, not about speed.
"$cmake" -S "$folder/app" -B "$folder/build" -G "$generator" "${hidden[@]}" \
  -DMIMICRY_STB=/nowhere -DMIMICRY_FONT=/nowhere -DMIMICRY_UNITY=ON -DMIMICRY_UNITY_FILES=0 \
  -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=-O0 -DBUILD_SHARED_LIBS=ON -DMIMICRY_INSTALL=ON \
  -DCMAKE_INSTALL_PREFIX=/usr -DCMAKE_INSTALL_LIBDIR=lib/x86_64-linux-gnu \
  -DCMAKE_CXX_COMPILER_LAUNCHER="$(command -v ccache || true)" >"$folder/configure.log" 2>&1 ||
  { cat "$folder/configure.log"; exit 1; }
"$cmake" --build "$folder/build" --parallel 2 >"$folder/build.log" 2>&1 || { tail -n 60 "$folder/build.log"; exit 1; }
run_readme_program "$folder/build/app" "$folder/by_subdirectory"
"$folder/build/draw" >"$folder/draw.txt"
if find "$folder/build" -name '*render*' -o -name '*serve*' -o -name '*_tests' | grep .; then
  echo "subproject: these parts were not asked for" >&2
  exit 1
fi

# Installed for a distribution.
DESTDIR=$folder/stage "$cmake" --install "$folder/build" >/dev/null
usr=$folder/stage/usr
libraries=$usr/lib/x86_64-linux-gnu
for file in include/mimicry/mimicry.h share/doc/mimicry/LICENSE share/doc/mimicry/THIRD_PARTY.md \
  lib/x86_64-linux-gnu/libmimicry_cpp.so lib/x86_64-linux-gnu/libmimicry.so; do
  [ -e "$usr/$file" ] || { echo "subproject: $file was not installed" >&2; exit 1; }
done
if find "$usr" -name '*.a' | grep .; then
  echo "subproject: an archive was installed where BUILD_SHARED_LIBS is on" >&2
  exit 1
fi
export LD_LIBRARY_PATH=$libraries
# shellcheck disable=SC2046
c++ -std=c++20 "$folder/app/main.cpp" $(with_pkg_config "$usr" --cflags --libs mimicry) -o "$folder/user/app"
# shellcheck disable=SC2046
cc -std=c99 "$folder/app/draw.c" $(with_pkg_config "$usr" --cflags --libs mimicry-c) -o "$folder/user/draw"
run_readme_program "$folder/user/app" "$folder/by_pkg_config"
diff -r "$folder/by_subdirectory" "$folder/by_pkg_config"
"$folder/user/draw" | diff "$folder/draw.txt" -

sed -i 's/^add_subdirectory.*/find_package(mimicry REQUIRED)/' "$folder/app/CMakeLists.txt"
"$cmake" -S "$folder/app" -B "$folder/user/build" -G "$generator" -DCMAKE_PREFIX_PATH="$usr" >/dev/null
"$cmake" --build "$folder/user/build" >/dev/null
run_readme_program "$folder/user/build/app" "$folder/by_find_package"
diff -r "$folder/by_subdirectory" "$folder/by_find_package"
