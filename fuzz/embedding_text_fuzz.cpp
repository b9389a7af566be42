// Text embeddings: the surface, a byte 1, the shell.

#include <cstdint>
#include <string_view>

#include <mimicry/base/error.h>
#include <mimicry/embedding/smooth_projector.h>
#include <mimicry/io/embedding_file.h>

#include "io/embedding_text.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mimicry;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const std::size_t middle = bytes.find('\x01');
  try {
    Embedding e = make_embedding(
        read_embedding_text(bytes.substr(0, middle), "surface", 3),
        read_embedding_text(middle == std::string_view::npos ? "" : bytes.substr(middle + 1),
                            "shell", 4));
    // What is made can be written and read.
    const std::string written = write_embedding(e);
    if (write_embedding(read_embedding(written, "output")) != written) __builtin_trap();
    const Target target(mesh_of(e));
    const SmoothProjector projector(std::move(e), target);
    projector.project(target.position({0, Vec3::Constant(1.0 / 3.0)}));
  } catch (const Error&) {
  }
  return 0;
}
