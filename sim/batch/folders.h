#pragma once

#include <filesystem>
#include <string_view>

namespace hedgehop::sim {

/// Creates a folder and the folders above it; none if the path is empty. Throws InputError with the folder and the
/// cause.
void create_folders(const std::filesystem::path& folder);

/// Returns whether a folder has a file. Throws InputError with the folder and the cause if it cannot be read.
bool has_file(const std::filesystem::path& folder, std::string_view name);

}  // namespace hedgehop::sim
