#pragma once

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

namespace hedgehop {

/// Returns why a file cannot be read; empty if it is a regular file that may be read.
inline std::string file_fault(const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  if (status.type() == std::filesystem::file_type::not_found) return "there is no such file";
  if (!error && !std::filesystem::is_regular_file(status)) return "it is not a regular file";
  if (!error && !std::ifstream(file)) error = {errno, std::generic_category()};
  return error ? "it cannot be read: " + error.message() : "";
}

}  // namespace hedgehop
