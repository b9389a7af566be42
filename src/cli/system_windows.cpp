#include <cerrno>
#include <clocale>
#include <codecvt>
#include <locale>

#include <fcntl.h>
#include <io.h>
#include <windows.h>

#include <shellapi.h>  // stands on windows.h

#include "cli/system.h"

namespace mimicry::cli {
namespace {

std::string to_utf8(const wchar_t* text) {
  // With the 0 at the end.
  const int size = WideCharToMultiByte(CP_UTF8, 0, text, -1, nullptr, 0, nullptr, nullptr);
  if (size <= 0) return {};
  std::string narrow(static_cast<std::size_t>(size), '\0');
  WideCharToMultiByte(CP_UTF8, 0, text, -1, narrow.data(), size, nullptr, nullptr);
  narrow.pop_back();
  return narrow;
}

// std::filesystem turns narrow paths into wide ones by the locale.
void read_narrow_paths_as_utf8() {
#if defined(__GLIBCXX__)
  std::locale::global(std::locale(std::locale::classic(), new std::codecvt_utf8_utf16<wchar_t>));
#else
  std::setlocale(LC_CTYPE, ".UTF-8");
#endif
}

// Progress lines steer the cursor, which older consoles must be asked for.
void understand_sequences(DWORD stream) {
  const HANDLE console = GetStdHandle(stream);
  DWORD mode = 0;
  if (GetConsoleMode(console, &mode) != 0)
    SetConsoleMode(console, mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING);
}

}  // namespace

// What main is given has lost the characters that the system's code page lacks.
std::vector<std::string> command_line(int argc, char** argv) {
  int count = 0;
  wchar_t** const wide = CommandLineToArgvW(GetCommandLineW(), &count);
  if (wide == nullptr) return {argv, argv + argc};
  std::vector<std::string> arguments;
  for (int i = 0; i < count; ++i) arguments.push_back(to_utf8(wide[i]));
  LocalFree(wide);
  return arguments;
}

void prepare_standard_streams() {
  read_narrow_paths_as_utf8();
  for (std::FILE* const stream : {stdin, stdout, stderr})
    if (_fileno(stream) >= 0) _setmode(_fileno(stream), _O_BINARY);
  SetConsoleOutputCP(CP_UTF8);
  understand_sequences(STD_OUTPUT_HANDLE);
  understand_sequences(STD_ERROR_HANDLE);
}

// The null device is a character device, too; a console has a mode.
bool is_terminal(std::FILE* stream) {
  const int file = _fileno(stream);
  DWORD mode = 0;
  return file >= 0 && GetConsoleMode(reinterpret_cast<HANDLE>(_get_osfhandle(file)), &mode) != 0;
}

bool output_reader_is_gone() {
  return errno == EPIPE || errno == EINVAL;
}

}  // namespace mimicry::cli
