# mimicry_module(NAME [SOURCES files...] [DEPENDS modules...] [LIBRARIES targets...] [TOOL] [INSTALL])
#
# One library target per module, `mimicry_NAME` (alias mimicry::NAME). Public headers stand under
# include/mimicry/NAME. A target sees the headers of its own module and of the modules that it
# depends on, through a folder of links made here, and no others: this is what keeps the one-way
# order of docs/architecture.md. TOOL modules need more than Eigen and stay out of the runtime;
# they are installed where INSTALL is given (their needs are then header-only and private).
function(mimicry_module name)
  cmake_parse_arguments(ARG "TOOL;INSTALL" "" "SOURCES;DEPENDS;LIBRARIES" ${ARGN})
  set(target mimicry_${name})
  set(links "${PROJECT_BINARY_DIR}/include/${name}")
  file(MAKE_DIRECTORY "${links}/mimicry")
  file(CREATE_LINK "${PROJECT_SOURCE_DIR}/include/mimicry/${name}" "${links}/mimicry/${name}" SYMBOLIC)

  if(ARG_SOURCES)
    add_library(${target} STATIC ${ARG_SOURCES})
    set(scope PUBLIC)
    target_compile_options(${target} PRIVATE ${MIMICRY_WARNINGS})
    target_include_directories(${target} PRIVATE "${PROJECT_SOURCE_DIR}/src")
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  mimicry_unity(${target})
  add_library(mimicry::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  if(NOT EMSCRIPTEN)
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  endif()
  target_compile_features(${target} ${scope} cxx_std_20)
  target_include_directories(${target} ${scope}
    "$<BUILD_INTERFACE:${links}>" "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>")
  target_link_libraries(${target} ${scope} mimicry_flags)
  foreach(dependency IN LISTS ARG_DEPENDS)
    target_link_libraries(${target} ${scope} mimicry_${dependency})
  endforeach()
  target_link_libraries(${target} ${scope} ${ARG_LIBRARIES})
  if(NOT ARG_TOOL)
    set_property(GLOBAL APPEND PROPERTY MIMICRY_RUNTIME_MODULES ${target})
  endif()
  if(ARG_INSTALL OR NOT ARG_TOOL)
    set_property(GLOBAL APPEND PROPERTY MIMICRY_INSTALLED ${target})
    set_property(GLOBAL APPEND PROPERTY MIMICRY_INSTALLED_HEADERS ${name})
  endif()
endfunction()

# What headers take to compile is taken once for every eight files.
function(mimicry_unity target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${MIMICRY_UNITY} UNITY_BUILD_BATCH_SIZE 8)
endfunction()

set(MIMICRY_WARNINGS -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wcast-qual)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # g++ 12 warns of overlaps inside std::string's operator+ that cannot happen (its bug 105651).
  list(APPEND MIMICRY_WARNINGS -Wno-restrict)
  if(MIMICRY_SANITIZE)
    # The checks that sanitizers add hide assignments from this warning (boost::optional, std::variant).
    list(APPEND MIMICRY_WARNINGS -Wno-maybe-uninitialized)
  endif()
endif()
if(MIMICRY_WERROR)
  list(APPEND MIMICRY_WARNINGS -Werror)
endif()

# Flags that every module and whoever links it share. Contraction into fused operations is off:
# the same input gives the same bits on every machine and in WebAssembly.
add_library(mimicry_flags INTERFACE)
target_compile_options(mimicry_flags INTERFACE $<BUILD_INTERFACE:-ffp-contract=off>)
if(MIMICRY_SANITIZE)
  target_compile_options(mimicry_flags INTERFACE
    $<BUILD_INTERFACE:-fsanitize=${MIMICRY_SANITIZE} -fno-omit-frame-pointer>)
  target_link_options(mimicry_flags INTERFACE $<BUILD_INTERFACE:-fsanitize=${MIMICRY_SANITIZE}>)
  if(MIMICRY_SANITIZE MATCHES "undefined")
    target_compile_options(mimicry_flags INTERFACE $<BUILD_INTERFACE:-fno-sanitize-recover=all>)
  endif()
endif()
set_target_properties(mimicry_flags PROPERTIES EXPORT_NAME flags)
set_property(GLOBAL APPEND PROPERTY MIMICRY_INSTALLED mimicry_flags)
