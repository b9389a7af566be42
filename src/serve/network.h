#pragma once

#include <string>
#include <vector>

namespace mimicry::serve {

/// The IPv4 addresses of the machine's interfaces, without the loopback.
std::vector<std::string> machine_addresses();

/// The machine's own name in lower case and the same in .local; empty where it has none.
std::vector<std::string> machine_names();

/// Lets the process open as many files as the system allows, up to `wanted`. Returns how many.
std::size_t allow_files(std::size_t wanted);

}  // namespace mimicry::serve
