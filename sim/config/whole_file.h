#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace hedgehop::sim {

/// Writes a file that is complete or absent: see PendingFile. Throws std::runtime_error with the file and the cause
/// (full disk, missing permission).
void write_file_whole(const std::filesystem::path& file, std::string_view text);

/// Returns all bytes of `file`. Throws InputError if the file does not exist or is not a regular file (a pipe may never
/// end), std::runtime_error for any other error. Both name the file and the cause.
std::string read_file_whole(const std::filesystem::path& file);

/// Checks before a flight whether a folder for results exists or can be created. Throws InputError with the folder and
/// the cause.
void require_writable(const std::filesystem::path& folder);
/// The same for the folder of a file. The file must not be a folder.
void require_writable_file(const std::filesystem::path& file);

}  // namespace hedgehop::sim
