include(CMakePackageConfigHelpers)

get_property(targets GLOBAL PROPERTY MIMICRY_INSTALLED)
get_property(modules GLOBAL PROPERTY MIMICRY_INSTALLED_HEADERS)
install(TARGETS ${targets} EXPORT mimicry-targets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
foreach(module IN LISTS modules)
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/mimicry/${module}"
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/mimicry)
endforeach()
if(TARGET mimicry_cli)
  install(TARGETS mimicry_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

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

# Static libraries are linked from the highest module down.
set(link_line "")
foreach(target IN LISTS targets)
  get_target_property(type ${target} TYPE)
  if(type STREQUAL "STATIC_LIBRARY")
    set(link_line "-l${target} ${link_line}")
  endif()
endforeach()
get_property(needs GLOBAL PROPERTY MIMICRY_INSTALLED_NEEDS)
list(JOIN needs " " needs)
file(WRITE "${PROJECT_BINARY_DIR}/mimicry.pc"
"prefix=\${pcfiledir}/../..
libdir=\${pcfiledir}/..
includedir=\${prefix}/${CMAKE_INSTALL_INCLUDEDIR}

Name: mimicry
Description: ${PROJECT_DESCRIPTION}
Version: ${PROJECT_VERSION}
Requires: eigen3
Cflags: -I\${includedir} -DEIGEN_MPL2_ONLY
Libs: -L\${libdir} ${link_line}${needs} -pthread
")
file(WRITE "${PROJECT_BINARY_DIR}/mimicry-c.pc"
"prefix=\${pcfiledir}/../..
libdir=\${pcfiledir}/..
includedir=\${prefix}/${CMAKE_INSTALL_INCLUDEDIR}

Name: mimicry-c
Description: ${PROJECT_DESCRIPTION}: the C interface
Version: ${PROJECT_VERSION}
Cflags: -I\${includedir}
Libs: -L\${libdir} -lmimicry
")
install(FILES "${PROJECT_BINARY_DIR}/mimicry.pc" "${PROJECT_BINARY_DIR}/mimicry-c.pc"
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
