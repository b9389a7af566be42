# mimicry_needs(PACKAGE [VERSION] [options of find_package...] FOR OPTION DEBIAN PACKAGE): finds the package,
# or says which option wants it, what Debian calls it, and how to do without. A macro, for the variables that
# find_package sets.
macro(mimicry_needs package)
  cmake_parse_arguments(NEEDS "" "FOR;DEBIAN" "" ${ARGN})
  find_package(${package} ${NEEDS_UNPARSED_ARGUMENTS} QUIET GLOBAL)
  if(NOT ${package}_FOUND)
    mimicry_missing("${package}" "${NEEDS_FOR}" "${NEEDS_DEBIAN}")
  endif()
endmacro()

# mimicry_missing(WHAT OPTION DEBIAN): the error that WHAT was not found.
function(mimicry_missing what option debian)
  set(without "")
  if(option MATCHES "^MIMICRY_")
    set(without ", or configure with -D${option}=OFF")
  endif()
  message(FATAL_ERROR "${option} needs ${what}, which was not found. Install it (Debian: ${debian})${without}.")
endfunction()
