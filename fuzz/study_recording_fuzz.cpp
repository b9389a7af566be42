#include <cstdint>
#include <string_view>

#include <mimicry/base/error.h>
#include <mimicry/io/study.h>

// The first byte chooses the file.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mimicry;
  if (size == 0) return 0;
  const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
  try {
    if (data[0] == 's')
      (void)write_study_sequence(read_study_sequence(text, "input"));
    else
      (void)write_recording(read_recording(text, "input"));
  } catch (const Error&) {
  }
  return 0;
}
