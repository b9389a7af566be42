# mimicry::mimicry, the one library that programs link: the objects of all modules that are installed
# (mimicry_module), in one archive, or in one shared library with BUILD_SHARED_LIBS. The modules' own
# targets keep the order of includes within this project, and are for its tests and tools.
#
# The file is libmimicry_cpp: libmimicry is the C interface, which other languages load.
get_property(modules GLOBAL PROPERTY MIMICRY_INSTALLED_MODULES)
set(objects "")
foreach(module IN LISTS modules)
  get_target_property(type mimicry_${module} TYPE)
  if(type STREQUAL "STATIC_LIBRARY")
    list(APPEND objects $<TARGET_OBJECTS:mimicry_${module}>)
  endif()
endforeach()
add_library(mimicry_cpp ${objects})
add_library(mimicry::mimicry ALIAS mimicry_cpp)
set_target_properties(mimicry_cpp PROPERTIES
  EXPORT_NAME mimicry LINKER_LANGUAGE CXX
  VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
  WINDOWS_EXPORT_ALL_SYMBOLS ON)
target_compile_features(mimicry_cpp INTERFACE cxx_std_20)
target_include_directories(mimicry_cpp INTERFACE
  "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>" "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>")
get_property(needs GLOBAL PROPERTY MIMICRY_INSTALLED_NEEDS)
target_link_libraries(mimicry_cpp PUBLIC mimicry_flags Eigen3::Eigen Threads::Threads PRIVATE ${needs})
