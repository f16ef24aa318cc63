#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace hedgehop::sim {

/// Writes `text` to `file` aside (`.part`) and renames it, so that a file that is there is whole.
/// What is there and no regular file (/dev/stdout, a pipe) is written into instead, and stays.
/// Throws std::runtime_error naming the file and the cause (full disk, missing permission); the part is then removed.
void write_file_whole(const std::filesystem::path& file, std::string_view text);

/// Returns all bytes of `file`. Throws InputError where it is none, or no regular one (a pipe would never end),
/// std::runtime_error for what else keeps it from being read; both name the file and the cause.
std::string read_file_whole(const std::filesystem::path& file);

/// Looks, before anything is flown for it, whether a folder for results is there or can be made. Throws InputError
/// naming it and the cause.
void require_writable(const std::filesystem::path& folder);
/// The same of the folder of a file, which is no folder itself.
void require_writable_file(const std::filesystem::path& file);

}  // namespace hedgehop::sim
