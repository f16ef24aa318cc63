#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <string_view>

#include "sim/batch/folders.h"
#include "sim/cli/exit_status.h"
#include "sim/config/whole_file.h"

namespace hedgehop::sim::cli {

/// Refuses a path with another extension than this one, such as ".html". A path without one is accepted.
inline CLI::Validator written_as(const std::string& extension) {
  const auto check = [extension](const std::string& path) -> std::string {
    const std::string found = std::filesystem::path(path).extension().string();
    return found.empty() || found == extension ? "" : "'" + path + "' would be written as " + extension;
  };
  return CLI::Validator(check, "");
}

/// Writes a file that the user names, and before it the folder if that is missing. Throws as require_writable_file().
inline void write_named_file(const std::filesystem::path& file, std::string_view text) {
  require_writable_file(file);
  create_folders(file.parent_path());
  write_file_whole(file, text);
}

/// Writes the page of a plot and prints its name to standard error.
inline void write_plot(const std::filesystem::path& file, std::string_view page) {
  write_named_file(file, page);
  notice(fmt::format("written: {}\n", file.string()));
}

}  // namespace hedgehop::sim::cli
