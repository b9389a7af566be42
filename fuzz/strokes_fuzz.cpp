#include <cstdint>
#include <string_view>

#include <mimicry/base/error.h>
#include <mimicry/io/strokes.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mimicry;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  try {
    const auto strokes = io::read_strokes(bytes, "input");
    // What is accepted can be written, and reads back to as much.
    const auto again = io::read_strokes(io::write_strokes(strokes), "output");
    if (again.size() != strokes.size()) __builtin_trap();
  } catch (const Error&) {
  }
  return 0;
}
