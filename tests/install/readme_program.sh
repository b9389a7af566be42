#!/usr/bin/env bash
# readme_program.sh CMAKE GENERATOR SOURCE BUILD FOLDER: installs BUILD into FOLDER and builds the README's
# program against it: through CMake, through pkg-config, and there with flags and compilers that the library was
# not built with. All of them draw the same, to the last bit.
set -euo pipefail
cmake=$1 generator=$2 source=$3 build=$4 folder=$5
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
# shellcheck source=tests/install/programs.sh
. "$here/programs.sh"
rm -rf "$folder"
mkdir -p "$folder/app"
"$cmake" --install "$build" --prefix "$folder/prefix" >/dev/null
"$folder/prefix/bin/mimicry" --version
ls "$folder"/prefix/share/doc/mimicry/{LICENSE,THIRD_PARTY.md} >/dev/null

program_of cpp "$source/README.md" >"$folder/app/main.cpp"
cat >"$folder/app/CMakeLists.txt" <<'CMAKE'
cmake_minimum_required(VERSION 3.25)
project(app CXX)
find_package(mimicry REQUIRED)
add_executable(app main.cpp)
target_link_libraries(app PRIVATE mimicry::mimicry)
CMAKE
"$cmake" -S "$folder/app" -B "$folder/app/build" -G "$generator" -DCMAKE_PREFIX_PATH="$folder/prefix" >/dev/null
"$cmake" --build "$folder/app/build" >/dev/null
run_readme_program "$folder/app/build/app" "$folder/by_cmake"

read -ra flags <<<"$(with_pkg_config "$folder/prefix" --cflags --libs mimicry)"
# by_pkg_config NAME COMPILER OPTIONS...
by_pkg_config() {
  local name=$1
  shift
  "$@" -std=c++20 "$folder/app/main.cpp" "${flags[@]}" -o "$folder/app/$name"
  run_readme_program "$folder/app/$name" "$folder/$name"
  diff -r "$folder/by_cmake" "$folder/$name" || {
    echo "readme_program: $* draws something else" >&2
    return 1
  }
}
by_pkg_config plain c++ -O2
by_pkg_config native c++ -O3 -march=native
grep -qw avx2 /proc/cpuinfo && by_pkg_config avx2 c++ -O2 -mavx2
by_pkg_config address c++ -O1 -fsanitize=address
# With Debian's libstdc++: clang's libc++ has other types, and does not link with a library built for this one.
by_pkg_config clang clang++ -O2
