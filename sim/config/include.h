#pragma once

#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include "sim/config/config_tree.h"

/// Files that use other files, and overrides of their values.
namespace hedgehop::sim {

/// Reads a file whose root is a map, and the files that it uses: with `use: other.yaml` a map overrides
/// the other file's root, map by map; lists and scalars replace. Paths are relative to the file that names them.
Node load_tree(const std::filesystem::path& file, ErrorList& errors);
/// @param read  gains every file that was read.
Node load_tree(const std::filesystem::path& file, ErrorList& errors, std::set<std::filesystem::path>& read);

/// As load_tree(), from a text; its paths are relative to the working folder. @param name  for positions, not a path.
Node parse_tree(const std::string& text, const std::string& name, ErrorList& errors,
                std::set<std::filesystem::path>& read);

/// Overrides `base` with `over`: maps key by key (see kSelectors), other values by replacement.
void override_with(Node& base, const Node& over);

/// Applies `a.b.0.c=value` in order; the value is YAML. `a.b.use=file` replaces `a.b` by the file's map, its path
/// relative to the folder of `file`. Missing maps of the path are created (the reader reports those that may not
/// exist).
/// @param read  gains every file that was read.
void apply_overrides(Node& root, std::span<const std::string> overrides, const std::filesystem::path& file,
                     ErrorList& errors, std::set<std::filesystem::path>& read);

/// Returns the folder of the scenarios installed with the running program; empty if there is no such folder.
std::filesystem::path installed_configs();

}  // namespace hedgehop::sim
