// What the C interface returns as a structure, written where JavaScript reads it.
#include <mimicry/mimicry.h>

extern "C" void mimicry_wasm_mesh_texcoords(const mimicry_mesh* mesh, mimicry_corner_values* out) {
  *out = mimicry_mesh_texcoords(mesh);
}

extern "C" void mimicry_wasm_mesh_colors(const mimicry_mesh* mesh, mimicry_corner_values* out) {
  *out = mimicry_mesh_colors(mesh);
}
