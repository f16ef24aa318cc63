#pragma once

#include <filesystem>
#include <string>

namespace hedgehop::sim {

/// Returns the bytes of a file that a person wrote. Throws std::invalid_argument with the reason, without the file's
/// name: there is none, it is no regular file (a folder, a device, a pipe that would never end), larger than 64 MB, or
/// not to be read.
std::string read_input_file(const std::filesystem::path& file);

/// The scenarios that are installed with the program that runs; empty where none are.
std::filesystem::path installed_configs();

}  // namespace hedgehop::sim
