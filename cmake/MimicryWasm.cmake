# Exceptions are WebAssembly's own. Eigen uses emscripten's SSE2 (on 128-bit lanes): it sums in the
# same order as in a native build then, which is what makes curves the same to the last bit. clang
# says to be gcc 4.2 and gets what Eigen has for that one's bugs, assembler; for a "5.13" it has no
# assembler of either kind.
add_compile_options(-fwasm-exceptions -msimd128 -msse2 -fgnuc-version=5.13.0)
add_link_options(-fwasm-exceptions)
include_directories(SYSTEM "${PROJECT_SOURCE_DIR}/wasm/native/include")

# What the WebAssembly build finds elsewhere than a native one. The system's include folder itself
# would hide emscripten's own headers: header-only packages are reached through a folder of links.
set(system_headers "${PROJECT_BINARY_DIR}/system_headers")
file(MAKE_DIRECTORY "${system_headers}")
file(CREATE_LINK /usr/include/nlohmann "${system_headers}/nlohmann" SYMBOLIC)
add_library(nlohmann_json::nlohmann_json INTERFACE IMPORTED GLOBAL)
set_target_properties(nlohmann_json::nlohmann_json PROPERTIES
  INTERFACE_INCLUDE_DIRECTORIES "${system_headers}")
