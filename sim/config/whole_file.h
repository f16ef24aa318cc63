#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

namespace hedgehop::sim {

/// Writes a file that is complete or absent: see PendingFile. Throws std::runtime_error with the file and the cause
/// (full disk, missing permission).
void write_file_whole(const std::filesystem::path& file, std::string_view text);

/// Returns "cannot be read: " and the cause.
std::string unreadable(const std::error_code& error);

/// Returns all bytes of `file`. Throws InputError if the file does not exist, is not a regular file (a pipe may never
/// end) or may not be read, std::runtime_error for an error of the machine. Both name the file and the cause.
std::string read_file_whole(const std::filesystem::path& file);

/// Returns the bytes of an input file. Throws std::invalid_argument with the reason, without the file's name, if the
/// file is missing, is not a regular file (folder, device, pipe), is larger than 64 MB, or cannot be read.
std::string read_input_file(const std::filesystem::path& file);

/// Checks before a flight whether a folder for results exists or can be created. Throws InputError with the folder and
/// the cause.
void require_writable(const std::filesystem::path& folder);
/// The same for the folder of a file. The file must not be a folder.
void require_writable_file(const std::filesystem::path& file);

}  // namespace hedgehop::sim
