#pragma once

#include <cstdio>
#include <string>
#include <vector>

namespace mimicry::cli {

// What systems do differently for programs of a terminal: system_posix.cpp, system_windows.cpp.

/// The command line in UTF-8, the program's name first.
std::vector<std::string> command_line(int argc, char** argv);

/// Before anything is read, printed or opened: closed streams are kept from becoming files, bytes
/// are written as they are, and texts are UTF-8.
void prepare_standard_streams();

bool is_terminal(std::FILE* stream);

/// Whether nobody reads standard output any more.
bool output_reader_is_gone();

}  // namespace mimicry::cli
