// Embedding files. The checksum is not compared in this build, so that what stands behind it is
// met.

#include <cstdint>
#include <string_view>

#include <mimicry/base/error.h>
#include <mimicry/embedding/smooth_projector.h>
#include <mimicry/io/embedding_file.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mimicry;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  try {
    Embedding e = read_embedding(bytes, "input");
    const std::string again = write_embedding(e);
    if (write_embedding(read_embedding(again, "output")) != again) __builtin_trap();
    const Target target(mesh_of(e));
    const SmoothProjector projector(std::move(e), target);
    projector.project(target.position({0, Vec3::Constant(1.0 / 3.0)}));
  } catch (const Error&) {
  }
  return 0;
}
