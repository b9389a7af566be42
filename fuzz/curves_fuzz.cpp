#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include <mimicry/base/error.h>
#include <mimicry/io/curves.h>
#include <mimicry/mesh/shapes.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mimicry;
  static const TriangleMesh mesh = make_box(1, 1, 1, Vec3::Ones());
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  try {
    const CurveSet set = is_packed_curves(bytes) ? read_curves_packed(bytes, "input", mesh)
                                                 : read_curves_json(bytes, "input", mesh);
    // What is accepted refers to nothing beyond the mesh: every writer can go through it.
    const std::string text = write_curves_json(set, mesh);
    if (write_curves_json(read_curves_json(text, "written", mesh), mesh) != text) std::abort();
    const std::string packed = write_curves_packed(set, mesh);
    if (write_curves_packed(read_curves_packed(packed, "written", mesh), mesh) != packed)
      std::abort();
    (void)write_curves_obj(set, mesh);
    (void)write_curves_csv(set, mesh);
  } catch (const Error&) {
  }
  return 0;
}
