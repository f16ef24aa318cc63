#pragma once

#include <filesystem>
#include <span>
#include <string_view>

/// The readers of input files, for fuzzing. Each succeeds, or throws InputError or the exceptions of its header.
namespace hedgehop::fuzz {

struct Reader {
  std::string_view name;       ///< of the target and of its corpus
  std::string_view extension;  ///< of its files
  void (*read)(const std::filesystem::path& file);
};

std::span<const Reader> readers();
/// Returns the reader of a name, or null.
const Reader* find(std::string_view name);

/// Runs the reader on a file of these bytes, next to links to the contents of `configs/` (`../rigs/x.yaml`). Its
/// documented exceptions are caught; others pass through. @return whether the file was read, not refused.
bool feed(const Reader& reader, std::string_view bytes);

}  // namespace hedgehop::fuzz
