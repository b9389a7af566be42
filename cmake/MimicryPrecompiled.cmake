# MIMICRY_PCH: Eigen and the standard headers, which nine tenths of a small file's time go into, are parsed
# once for all modules and once for all programs (whose code is placed otherwise). Own headers stay out: who
# may include which is for the compiler to say.
set(headers algorithm array cmath cstddef cstdint functional memory optional span string string_view utility
  vector Eigen/Core Eigen/Geometry)
list(TRANSFORM headers REPLACE "(.+)" "<\\1>")

function(mimicry_precompiled_headers target)
  add_library(${target} OBJECT "${PROJECT_BINARY_DIR}/precompiled.cpp")
  target_link_libraries(${target} PRIVATE mimicry_flags Eigen3::Eigen Threads::Threads)
  target_compile_features(${target} PRIVATE cxx_std_20)
  target_compile_options(${target} PRIVATE ${MIMICRY_WARNINGS})
  target_precompile_headers(${target} PRIVATE ${headers})
endfunction()

if(MIMICRY_PCH)
  # A file's time within a precompiled header would hide from ccache that nothing changed.
  if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    target_compile_options(mimicry_flags INTERFACE $<BUILD_INTERFACE:SHELL:-Xclang -fno-pch-timestamp>)
    set(CMAKE_PCH_INSTANTIATE_TEMPLATES ON)
  endif()
  file(WRITE "${PROJECT_BINARY_DIR}/precompiled.cpp" "")
  mimicry_precompiled_headers(mimicry_pch)
  set_target_properties(mimicry_pch PROPERTIES POSITION_INDEPENDENT_CODE ON)
  mimicry_precompiled_headers(mimicry_program_pch)
endif()

# mimicry_precompiled(TARGET): of C++ alone, with no flags but the modules' own.
function(mimicry_precompiled target)
  if(NOT MIMICRY_PCH)
    return()
  endif()
  get_target_property(type ${target} TYPE)
  if(type STREQUAL "EXECUTABLE")
    target_precompile_headers(${target} REUSE_FROM mimicry_program_pch)
  else()
    target_precompile_headers(${target} REUSE_FROM mimicry_pch)
  endif()
endfunction()
