#include "cli/report/bundle.h"

// The files' paths are set by the build.
#define MIMICRY_LINK_FILE(name, path) \
  asm(".section .rodata\n"            \
      ".balign 16\n"                  \
      "mimicry_" name                 \
      "_begin:\n"                     \
      ".incbin \"" path               \
      "\"\n"                          \
      "mimicry_" name                 \
      "_end:\n"                       \
      ".previous\n")

MIMICRY_LINK_FILE("page_script", MIMICRY_PAGE_SCRIPT);
MIMICRY_LINK_FILE("files_script", MIMICRY_FILES_SCRIPT);

namespace mimicry::cli {
namespace {
extern "C" {
[[gnu::visibility("hidden")]] extern const char mimicry_page_script_begin[];
[[gnu::visibility("hidden")]] extern const char mimicry_page_script_end[];
[[gnu::visibility("hidden")]] extern const char mimicry_files_script_begin[];
[[gnu::visibility("hidden")]] extern const char mimicry_files_script_end[];
}

std::string_view between(const char* begin, const char* end) {
  return {begin, static_cast<std::size_t>(end - begin)};
}

}  // namespace

std::string_view page_script() {
  return between(mimicry_page_script_begin, mimicry_page_script_end);
}

std::string_view files_script() {
  return between(mimicry_files_script_begin, mimicry_files_script_end);
}

}  // namespace mimicry::cli
