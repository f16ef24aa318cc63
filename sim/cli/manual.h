#pragma once

#include <CLI/App.hpp>
#include <string>
#include <string_view>

/// The manual page and the shells' completions, made from the same declarations as `--help`.
namespace hedgehop::sim::cli {

/// @param app  with all its commands declared.  @param format  man, bash, zsh or fish.  Throws std::invalid_argument on
/// others.
std::string manual(const CLI::App& app, std::string_view format);

}  // namespace hedgehop::sim::cli
