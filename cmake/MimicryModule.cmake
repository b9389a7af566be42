# mimicry_module(NAME [SOURCES files...] [DEPENDS modules...] [LIBRARIES targets...] [TOOL] [INSTALL])
#
# One library target per module, `mimicry_NAME` (alias mimicry::NAME). Public headers stand under
# include/mimicry/NAME and are included as <mimicry/NAME/file.h>; what only modules of this project
# use stands beside its sources, is included as "NAME/file.h" and is not installed. A target sees the
# headers of its own module and of the modules that it depends on, through a folder of links made
# here, and no others: this is what keeps the one-way order of docs/architecture.md. TOOL modules need
# more than Eigen and stay out of the library that is installed (MimicryLibrary.cmake), unless INSTALL
# is given: their needs are then header-only and private.
function(mimicry_module name)
  cmake_parse_arguments(ARG "TOOL;INSTALL" "" "SOURCES;DEPENDS;LIBRARIES" ${ARGN})
  set(target mimicry_${name})
  set(links "${PROJECT_BINARY_DIR}/include/${name}")
  file(MAKE_DIRECTORY "${links}/mimicry")
  if(EXISTS "${PROJECT_SOURCE_DIR}/include/mimicry/${name}")
    file(CREATE_LINK "${PROJECT_SOURCE_DIR}/include/mimicry/${name}" "${links}/mimicry/${name}" SYMBOLIC)
  endif()
  mimicry_own_headers(${name})

  if(ARG_SOURCES)
    add_library(${target} STATIC ${ARG_SOURCES})
    set(scope PUBLIC)
    target_compile_options(${target} PRIVATE ${MIMICRY_WARNINGS})
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  mimicry_unity(${target})
  if(ARG_SOURCES)
    mimicry_precompiled(${target})
  endif()
  add_library(mimicry::${name} ALIAS ${target})
  if(NOT EMSCRIPTEN)
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  endif()
  target_compile_features(${target} ${scope} cxx_std_20)
  target_include_directories(${target} ${scope}
    "${links}")
  target_link_libraries(${target} ${scope} mimicry_flags)
  foreach(dependency IN LISTS ARG_DEPENDS)
    target_link_libraries(${target} ${scope} mimicry_${dependency})
  endforeach()
  target_link_libraries(${target} ${scope} ${ARG_LIBRARIES})
  if(NOT ARG_TOOL)
    set_property(GLOBAL APPEND PROPERTY MIMICRY_CORE_MODULES ${name})
  endif()
  if(ARG_INSTALL OR NOT ARG_TOOL)
    set_property(GLOBAL APPEND PROPERTY MIMICRY_INSTALLED_MODULES ${name})
  endif()
endfunction()

# Lets NAME's sources include what stands beside them as "NAME/file.h".
function(mimicry_own_headers name)
  file(MAKE_DIRECTORY "${PROJECT_BINARY_DIR}/include/${name}")
  file(CREATE_LINK "${PROJECT_SOURCE_DIR}/src/${name}" "${PROJECT_BINARY_DIR}/include/${name}/${name}" SYMBOLIC)
endfunction()

# What headers take to compile is taken once for several files.
function(mimicry_unity target)
  set_target_properties(${target} PROPERTIES
    UNITY_BUILD ${MIMICRY_UNITY} UNITY_BUILD_BATCH_SIZE ${MIMICRY_UNITY_FILES})
endfunction()

if(MSVC)
  set(MIMICRY_WARNINGS /W4)
else()
  set(MIMICRY_WARNINGS -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wcast-qual)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # g++ 12 warns of overlaps and of lengths inside std::string's operator+ that cannot happen (its bug 105651),
  # under each of these names in turn; clang and the sanitizers look for the real ones.
  list(APPEND MIMICRY_WARNINGS -Wno-restrict -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread)
  if(MIMICRY_SANITIZE)
    # The checks that sanitizers add hide assignments from this warning (boost::optional, std::variant).
    list(APPEND MIMICRY_WARNINGS -Wno-maybe-uninitialized)
  endif()
endif()
if(MIMICRY_WERROR)
  list(APPEND MIMICRY_WARNINGS $<IF:$<BOOL:${MSVC}>,/WX,-Werror>)
endif()

# Flags that every module and whoever links it share. Contraction into fused operations is off:
# the same input gives the same bits on every machine and in WebAssembly. Eigen's types are laid out alike
# whatever the processor that a program is compiled for (with AVX it would align them to 32 bytes), and only
# its permissive part may come in; mimicry.pc says the same two.
add_library(mimicry_flags INTERFACE)
set(MIMICRY_EIGEN_DEFINITIONS EIGEN_MAX_ALIGN_BYTES=16 EIGEN_MPL2_ONLY)
target_compile_definitions(mimicry_flags INTERFACE ${MIMICRY_EIGEN_DEFINITIONS})
if(MSVC)
  target_compile_options(mimicry_flags INTERFACE
    $<BUILD_INTERFACE:/fp:precise> $<BUILD_INTERFACE:/permissive-> $<BUILD_INTERFACE:/utf-8>
    $<BUILD_INTERFACE:/bigobj> $<BUILD_INTERFACE:/EHsc>)
else()
  target_compile_options(mimicry_flags INTERFACE $<BUILD_INTERFACE:-ffp-contract=off>)
endif()
if(WIN32)
  # windows.h defines no min and max, and takes texts in UTF-16.
  target_compile_definitions(mimicry_flags INTERFACE
    $<BUILD_INTERFACE:NOMINMAX> $<BUILD_INTERFACE:WIN32_LEAN_AND_MEAN> $<BUILD_INTERFACE:UNICODE>)
endif()
if(MIMICRY_SANITIZE)
  target_compile_options(mimicry_flags INTERFACE
    $<BUILD_INTERFACE:-fsanitize=${MIMICRY_SANITIZE} -fno-omit-frame-pointer>)
  target_link_options(mimicry_flags INTERFACE $<BUILD_INTERFACE:-fsanitize=${MIMICRY_SANITIZE}>)
  if(MIMICRY_SANITIZE MATCHES "undefined")
    target_compile_options(mimicry_flags INTERFACE $<BUILD_INTERFACE:-fno-sanitize-recover=all>)
  endif()
endif()
set_target_properties(mimicry_flags PROPERTIES EXPORT_NAME flags)
