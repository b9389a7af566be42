# What `cmake --install` brings: the library with its headers, for CMake and for pkg-config, the C
# interface, the program with the studio's page, licences and examples.
include(CMakePackageConfigHelpers)

set(targets mimicry_cpp mimicry_flags)
if(TARGET mimicry_c)
  list(APPEND targets mimicry_c)
endif()
install(TARGETS ${targets} EXPORT mimicry-targets
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR}
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})

get_property(modules GLOBAL PROPERTY MIMICRY_INSTALLED_MODULES)
foreach(module IN LISTS modules)
  if(IS_DIRECTORY "${PROJECT_SOURCE_DIR}/include/mimicry/${module}")
    install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/mimicry/${module}"
      DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/mimicry)
  endif()
endforeach()
file(GLOB headers "${PROJECT_SOURCE_DIR}/include/mimicry/*.h")
if(NOT TARGET mimicry_c)
  list(FILTER headers EXCLUDE REGEX "/mimicry\\.h$")
endif()
install(FILES ${headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/mimicry)

if(TARGET mimicry_cli)
  install(TARGETS mimicry_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  if(MIMICRY_SERVE)
    # Where `mimicry serve` looks, beside the program's folder; the preset `wasm` builds the page.
    install(DIRECTORY "${PROJECT_SOURCE_DIR}/web/dist/"
      DESTINATION ${CMAKE_INSTALL_BINDIR}/../share/mimicry/studio OPTIONAL)
    install(CODE "if(NOT EXISTS \"${PROJECT_SOURCE_DIR}/web/dist/index.html\")
      message(STATUS \"The studio's page is not built, and not installed: cmake --preset wasm, then cmake --build --preset wasm\")\nendif()")
  endif()
endif()
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" "${PROJECT_SOURCE_DIR}/THIRD_PARTY.md"
  DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY "${PROJECT_SOURCE_DIR}/examples" DESTINATION ${CMAKE_INSTALL_DOCDIR} OPTIONAL)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/mimicry)
install(EXPORT mimicry-targets NAMESPACE mimicry:: DESTINATION ${package_dir})
file(WRITE "${PROJECT_BINARY_DIR}/mimicry-config.cmake"
"include(CMakeFindDependencyMacro)
find_dependency(Eigen3 3.4 NO_MODULE)
find_dependency(Threads)
include(\"\${CMAKE_CURRENT_LIST_DIR}/mimicry-targets.cmake\")
")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/mimicry-config-version.cmake"
  COMPATIBILITY SameMinorVersion)
install(FILES
  "${PROJECT_BINARY_DIR}/mimicry-config.cmake" "${PROJECT_BINARY_DIR}/mimicry-config-version.cmake"
  DESTINATION ${package_dir})

# pkg-config's files tell folders from where they stand themselves, so that the tree can be moved; the way
# up depends on how deep the library's folder is (lib, lib/x86_64-linux-gnu).
if(IS_ABSOLUTE "${CMAKE_INSTALL_LIBDIR}" OR IS_ABSOLUTE "${CMAKE_INSTALL_INCLUDEDIR}")
  set(folders "prefix=${CMAKE_INSTALL_PREFIX}
libdir=${CMAKE_INSTALL_FULL_LIBDIR}
includedir=${CMAKE_INSTALL_FULL_INCLUDEDIR}")
else()
  file(RELATIVE_PATH up "/prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/prefix")
  string(REGEX REPLACE "/$" "" up "${up}")
  set(folders "prefix=\${pcfiledir}/${up}
libdir=\${prefix}/${CMAKE_INSTALL_LIBDIR}
includedir=\${prefix}/${CMAKE_INSTALL_INCLUDEDIR}")
endif()
list(TRANSFORM MIMICRY_EIGEN_DEFINITIONS PREPEND "-D" OUTPUT_VARIABLE definitions)
list(JOIN definitions " " definitions)
get_property(needs GLOBAL PROPERTY MIMICRY_INSTALLED_NEEDS)
list(JOIN needs " " needs)
set(libraries "-L\${libdir} -lmimicry_cpp")
if(NOT BUILD_SHARED_LIBS) # an archive alone: what it needs is needed without --static as well
  string(APPEND libraries " ${needs} -pthread")
endif()
file(WRITE "${PROJECT_BINARY_DIR}/mimicry.pc"
"${folders}

Name: mimicry
Description: ${PROJECT_DESCRIPTION}
Version: ${PROJECT_VERSION}
Requires: eigen3
Cflags: -I\${includedir} ${definitions}
Libs: ${libraries}
")
file(WRITE "${PROJECT_BINARY_DIR}/mimicry-c.pc"
"${folders}

Name: mimicry-c
Description: ${PROJECT_DESCRIPTION}: the C interface
Version: ${PROJECT_VERSION}
Cflags: -I\${includedir}
Libs: -L\${libdir} -lmimicry
")
set(pc_files "${PROJECT_BINARY_DIR}/mimicry.pc")
if(TARGET mimicry_c)
  list(APPEND pc_files "${PROJECT_BINARY_DIR}/mimicry-c.pc")
endif()
install(FILES ${pc_files} DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
