#!/usr/bin/env bash
# examples.sh CMAKE GENERATOR BUILD FOLDER: installs BUILD into FOLDER; each example builds there, from what is
# installed alone, and does what it should.
set -euo pipefail
cmake=$1 generator=$2 build=$3 folder=$4
rm -rf "$folder"
mkdir -p "$folder"
"$cmake" --install "$build" --prefix "$folder/prefix" >/dev/null
examples=$folder/prefix/share/doc/mimicry/examples
programs=()
for project in "$examples"/*/CMakeLists.txt; do
  name=$(basename "$(dirname "$project")")
  "$cmake" -S "$examples/$name" -B "$folder/$name" -G "$generator" -DCMAKE_PREFIX_PATH="$folder/prefix" >/dev/null
  "$cmake" --build "$folder/$name" >/dev/null
  for program in "$folder/$name"/example_*; do
    [ -f "$program" ] && programs+=("$program")
  done
done
[ ${#programs[@]} -ge 6 ] || { echo "examples: built only ${programs[*]}" >&2; exit 1; }
export LD_LIBRARY_PATH=$folder/prefix/lib
python3 "$examples/run_all.py" "${programs[@]}"
