#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

namespace hedgehop::sim::cli {

/// Refuses a path with another extension than this one, such as ".html". A path without one is accepted.
inline CLI::Validator written_as(const std::string& extension) {
  const auto check = [extension](const std::string& path) -> std::string {
    const std::string found = std::filesystem::path(path).extension().string();
    return found.empty() || found == extension ? "" : "'" + path + "' would be written as " + extension;
  };
  return CLI::Validator(check, "");
}

}  // namespace hedgehop::sim::cli
