# Sourced by the tests of this folder: the programs that the documents show, and how they are run.

# program_of LANGUAGE DOCUMENT: the document's first program in that language.
program_of() { sed -n "/^\`\`\`$1\$/,/^\`\`\`\$/p" "$2" | sed '1d;/^```$/,$d'; }

# run_readme_program PROGRAM FOLDER: runs the README's program, which has to draw something; what it prints and
# writes is left in FOLDER. Its mesh is baked once and the bake kept beside FOLDER.
run_readme_program() {
  local program data
  program=$(realpath "$1")
  data=$(realpath "${source:?}/examples/data")
  rm -rf "$2"
  mkdir -p "$2"
  (cd "$2" && MIMICRY_CACHE=../readme_cache "$program" "$data/torus.obj" "$data/strokes.json" curves.json >printed.txt)
  if ! { grep -q '^145 points' "$2/printed.txt" && grep -q '^146 points' "$2/printed.txt" && [ -s "$2/curves.json" ]; }; then
    echo "$1: the README's program printed: $(cat "$2/printed.txt")" >&2
    return 1
  fi
}

# with_pkg_config PREFIX ARGUMENTS...: pkg-config for what is installed under PREFIX.
with_pkg_config() {
  local folder
  folder=$(dirname "$(find "$1" -name mimicry.pc)")
  shift
  PKG_CONFIG_PATH=$folder pkg-config "$@"
}
