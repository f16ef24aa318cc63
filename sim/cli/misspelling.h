#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>

/// Messages for misspelled commands and options, with the nearest valid name.
namespace hedgehop::sim::cli {

/// Returns the message for a first word that is not a command; empty if it is a command or an option.
std::string unknown_command(const CLI::App& app, std::string_view word);

/// Returns the message for the first unknown option of the parsed command; empty if there is none.
std::string unknown_option(const CLI::App& app);

}  // namespace hedgehop::sim::cli
