#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace mimicry::cli {

/// A subcommand that this program was built without: it is listed, and says what it would need.
/// needs: such as "the option MIMICRY_SERVE (Boost, OpenSSL)".
void add_missing_command(CLI::App& app, const std::string& name, const std::string& title,
                         const std::string& needs);

}  // namespace mimicry::cli
