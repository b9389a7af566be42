# GTest::gtest and GTest::gmock from GoogleTest's sources, as the package googletest installs them: for
# systems that the tests are built for on another one.
function(mimicry_googletest)
  set(root /usr/src/googletest)
  if(NOT EXISTS "${root}/googletest/src/gtest-all.cc")
    message(FATAL_ERROR "${root}: GoogleTest's sources are missing; install the package googletest (scripts/setup)")
  endif()
  add_library(built_googletest STATIC
    ${root}/googletest/src/gtest-all.cc ${root}/googlemock/src/gmock-all.cc)
  target_include_directories(built_googletest SYSTEM PUBLIC
    ${root}/googletest/include ${root}/googlemock/include)
  target_include_directories(built_googletest SYSTEM PRIVATE ${root}/googletest ${root}/googlemock)
  if(EMSCRIPTEN)
    target_compile_definitions(built_googletest PUBLIC GTEST_HAS_PTHREAD=0)
  endif()
  target_compile_features(built_googletest PUBLIC cxx_std_20)
  target_compile_options(built_googletest PRIVATE -O1)
  add_library(GTest::gtest ALIAS built_googletest)
  add_library(GTest::gmock ALIAS built_googletest)
endfunction()
