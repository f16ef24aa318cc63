#pragma once

#include <CLI/App.hpp>
#include <string>
#include <string_view>
#include <vector>

/// The manual page, the reference page and the shell completions, generated from the definitions that `--help` prints.
namespace hedgehop::sim::cli {

/// An option or a positional argument of a command.
struct ManualEntry {
  std::string name;                  ///< longest name, such as "--seed"; of a positional argument its placeholder
  std::vector<std::string> names;    ///< all names, short ones first; empty for a positional argument
  std::string value;                 ///< placeholder of the value; empty for a flag
  std::vector<std::string> choices;  ///< the valid values, if they are a fixed set
  std::string meaning;
  bool is_folder = false;
  bool is_required = false;
};

/// The visible options and positional arguments of a command.
std::vector<ManualEntry> manual_entries(const CLI::App& command);

/// `text` with each occurrence of `pattern` replaced.
std::string replaced(std::string text, std::string_view pattern, std::string_view replacement);

/// @param app  with all its commands declared.  @param format  "man" or "markdown" (docs/commands.md).
/// Throws std::invalid_argument for other formats.
std::string manual(const CLI::App& app, std::string_view format);

/// @param app  with all its commands declared.  @param shell  "bash", "zsh" or "fish".
/// Throws std::invalid_argument for other shells.
std::string completions(const CLI::App& app, std::string_view shell);

}  // namespace hedgehop::sim::cli
