// The bake with its progress as a call of JavaScript: a function pointer would need a table that
// grows.
#include <emscripten.h>

#include <mimicry/mimicry.h>

EM_JS(int32_t, mimicry_wasm_progress, (const char* stage, double fraction), {
  return Module["onBakeProgress"] ? Module["onBakeProgress"](UTF8ToString(stage), fraction) : 1;
});

extern "C" mimicry_status mimicry_wasm_bake(const mimicry_mesh* mesh,
                                            const mimicry_bake_options* options,
                                            mimicry_bytes** out) {
  return mimicry_bake(
      mesh, options,
      [](void*, const char* stage, double fraction) {
        return mimicry_wasm_progress(stage, fraction);
      },
      nullptr, out);
}

extern "C" void mimicry_wasm_default_bake_options(mimicry_bake_options* options) {
  *options = mimicry_default_bake_options();
}
