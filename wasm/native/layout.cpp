// The facade reads these structures in memory (src/*.ts): where their members lie.
#include <cstddef>

#include <mimicry/mimicry.h>

static_assert(sizeof(void*) == 4 && sizeof(mimicry_status) == 4);
static_assert(offsetof(mimicry_file, size) == 8 && sizeof(mimicry_file) == 12);
static_assert(offsetof(mimicry_mesh_report, vertices) == 72 && sizeof(mimicry_mesh_report) == 128);
static_assert(sizeof(mimicry_shape_info) == 20);
static_assert(offsetof(mimicry_surface_point, face) == 80 && sizeof(mimicry_surface_point) == 88);
static_assert(offsetof(mimicry_option_info, defaults) == 32 && sizeof(mimicry_option_info) == 72);
static_assert(offsetof(mimicry_technique_info, options) == 48);
static_assert(sizeof(mimicry_path_point) == 40);
static_assert(sizeof(mimicry_similarity) == 64 && sizeof(mimicry_frame) == 136);
static_assert(sizeof(mimicry_ink) == 32);
static_assert(offsetof(mimicry_curve_point, face) == 88 && sizeof(mimicry_curve_point) == 96);
static_assert(offsetof(mimicry_bake_options, offset) == 8 && sizeof(mimicry_bake_options) == 24);
static_assert(offsetof(mimicry_option_info, lowest) == 56);
static_assert(offsetof(mimicry_own_technique, memory_size) == 44 &&
              sizeof(mimicry_own_technique) == 56);
static_assert(offsetof(mimicry_surface_point, barycentric) == 48);
static_assert(offsetof(mimicry_corner_values, corners) == 8 && sizeof(mimicry_corner_values) == 12);
