#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include <mimicry/base/error.h>
#include <mimicry/io/study.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mimicry;
  try {
    const auto set = read_targets({reinterpret_cast<const char*>(data), size}, "input");
    // What is accepted can be written and reads back alike.
    const std::string text = write_targets(set, "");
    if (write_targets(read_targets(text, "written"), "") != text) std::abort();
  } catch (const Error&) {
  }
  return 0;
}
