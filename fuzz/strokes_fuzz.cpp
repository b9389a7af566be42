#include <cstdint>
#include <string_view>

#include <mimicry/base/error.h>
#include <mimicry/io/strokes.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mimicry;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  try {
    const auto file = read_strokes(bytes, "input");
    if (file.numbers.size() != file.strokes.size()) __builtin_trap();
    // What is accepted can be written, and reads back to as much.
    const auto again = read_strokes(write_strokes(file.strokes), "output");
    if (again.strokes.size() != file.strokes.size() || !again.left_out.empty()) __builtin_trap();
  } catch (const Error&) {
  }
  return 0;
}
