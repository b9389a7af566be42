# Sourced by the tests of this folder: the programs that the documents show, and how they are run.

# program_of LANGUAGE DOCUMENT: the document's first program in that language.
program_of() { sed -n "/^\`\`\`$1\$/,/^\`\`\`\$/p" "$2" | sed '1d;/^```$/,$d'; }

# run_readme_program PROGRAM FOLDER: runs the README's program, which has to draw something; what it prints and
# writes is left in FOLDER.
run_readme_program() {
  local program
  program=$(realpath "$1")
  rm -rf "$2"
  mkdir -p "$2"
  (cd "$2" && "$program" >printed.txt)
  grep -q '^90 points' "$2/printed.txt" || {
    echo "$1: the README's program printed: $(cat "$2/printed.txt")" >&2
    return 1
  }
}

# with_pkg_config PREFIX ARGUMENTS...: pkg-config for what is installed under PREFIX.
with_pkg_config() {
  local folder
  folder=$(dirname "$(find "$1" -name mimicry.pc)")
  shift
  PKG_CONFIG_PATH=$folder pkg-config "$@"
}
