// Techniques that are written in JavaScript: one function of the code's own table stands for all of
// them, and their number tells which is meant. The table need not grow, and a memory that is handed
// over to another instance holds no pointer that this instance alone knows.
#include <emscripten.h>

#include <mimicry/mimicry.h>

EM_JS(int32_t, mimicry_wasm_step,
      (int32_t number, const void* target, const void* frame, double metres_per_unit,
       const void* options, void* memory, void* point),
      {
        return Module["onTechniqueStep"](number, target, frame, metres_per_unit, options, memory,
                                         point);
      });

namespace {

mimicry_answer step(void* user, const mimicry_target* target, const mimicry_frame* frame,
                    double metres_per_unit, const double* options, void* memory,
                    mimicry_surface_point* point) {
  return static_cast<mimicry_answer>(
      mimicry_wasm_step(static_cast<int32_t>(reinterpret_cast<intptr_t>(user)), target, frame,
                        metres_per_unit, options, memory, point));
}

}  // namespace

// The row's `user` is its number; its `step` is set here.
extern "C" mimicry_status mimicry_wasm_technique_register(mimicry_own_technique* row) {
  row->step = step;
  return mimicry_technique_register(row, nullptr);
}
