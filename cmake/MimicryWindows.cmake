# What a build for Windows on another system finds elsewhere. The system's include folder itself would
# hide the compiler's own headers: header-only packages are reached through a folder of links, and
# find_package finds them there.
set(system_headers "${PROJECT_BINARY_DIR}/system_headers")
file(MAKE_DIRECTORY "${system_headers}")
foreach(header nlohmann CLI tiny_gltf.h tiny_obj_loader.h)
  file(CREATE_LINK "/usr/include/${header}" "${system_headers}/${header}" SYMBOLIC)
endforeach()
foreach(package nlohmann_json CLI11)
  set(folder "${PROJECT_BINARY_DIR}/packages/${package}")
  file(WRITE "${folder}/${package}Config.cmake"
"if(NOT TARGET ${package}::${package})
  add_library(${package}::${package} INTERFACE IMPORTED)
  set_target_properties(${package}::${package} PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES \"${system_headers}\")
endif()
")
  file(WRITE "${folder}/${package}ConfigVersion.cmake"
    "set(PACKAGE_VERSION 0)\nset(PACKAGE_VERSION_COMPATIBLE TRUE)\n")
  set(${package}_DIR "${folder}" CACHE PATH "Headers alone, through links" FORCE)
endforeach()

# Objects of a few files at once have more sections than the format's first kind holds.
add_compile_options(-Wa,-mbig-obj)
