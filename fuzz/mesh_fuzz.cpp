// One program per format: whatever the bytes, the reader gives a mesh or an Error. A mesh must
// come back the same from PLY, which holds every bit.

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include <mimicry/base/error.h>
#include <mimicry/io/meshes.h>

namespace {

using mimicry::MeshFormat;
using mimicry::TriangleMesh;

void require(bool condition) {
  if (!condition) std::abort();
}

bool same(const TriangleMesh& a, const TriangleMesh& b) {
  if (a.vertex_count() != b.vertex_count() || a.face_count() != b.face_count()) return false;
  for (mimicry::Index f = 0; f < a.face_count(); ++f)
    if (a.face(f) != b.face(f)) return false;
  for (mimicry::Index v = 0; v < a.vertex_count(); ++v)
    for (int k = 0; k < 3; ++k) {
      const double x = a.position(v)[k];
      const double y = b.position(v)[k];
      if (x != y && (x == x || y == y)) return false;
    }
  return true;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  TriangleMesh mesh;
  try {
    // glTF may use one mesh many times: small limits keep each run short.
    mesh = mimicry::read_mesh(
        bytes, MeshFormat::MIMICRY_FUZZ_FORMAT, "input",
        {.max_vertices = 100'000, .max_faces = 100'000, .max_unfolded = 100'000});
  } catch (const mimicry::Error&) {
    return 0;
  }
  require(mesh.face_count() > 0);
  for (const bool text : {false, true})
    require(
        same(mesh, mimicry::read_mesh(mimicry::write_mesh(mesh, MeshFormat::ply, {.text = text}),
                                      MeshFormat::ply, "copy")));
  return 0;
}
