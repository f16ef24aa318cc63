#pragma once

#include <filesystem>
#include <span>
#include <string_view>

/// What reads files of others, for fuzzing: each throws InputError, or what its header names, or succeeds.
namespace hedgehop::fuzz {

struct Reader {
  std::string_view name;       ///< of the target and of its corpus
  std::string_view extension;  ///< of its files
  void (*read)(const std::filesystem::path& file);
};

std::span<const Reader> readers();
/// The reader of a name, or null.
const Reader* find(std::string_view name);

/// Lets it read a file of these bytes, beside links to everything in `configs/` (`../rigs/x.yaml`). What it may throw
/// is swallowed; anything else passes.
void feed(const Reader& reader, std::string_view bytes);

}  // namespace hedgehop::fuzz
