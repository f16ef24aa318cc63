#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "sim/scenario/tree.h"

namespace hedgehop::sim {

/// Keys that name the choice of a variant (Field::selector): laying one of these over another value replaces the whole
/// map, for the keys beside it belong to the other choice.
inline constexpr std::string_view kSelectors[] = {"type", "module", "check"};

/// Parses one YAML document. Doubled keys, merge keys, tags, several documents, an empty text and syntax errors go to
/// `faults`; aliases are copied. @param file  name for places. @return what could be read, possibly null.
Node parse_yaml(const std::string& text, const std::string& file, Faults& faults);

/// Reads a file whose root is a map, and the files that it uses: `use: other.yaml` in any map lays that map over the
/// other file's root, map by map; lists and scalars replace. Paths are relative to the file that names them.
Node load_tree(const std::filesystem::path& file, Faults& faults);

/// Lays `over` upon `base`: maps key by key (see kSelectors), all else by replacement.
void override_with(Node& base, const Node& over);

/// Applies `a.b.0.c=value` in order; the value is YAML. `a.b.use=file` replaces `a.b` by the file's map, its path
/// relative to the folder of `file`. Missing maps on the way are made (whether they may exist, the reader will tell).
void apply_overrides(Node& root, std::span<const std::string> overrides, const std::filesystem::path& file,
                     Faults& faults);

}  // namespace hedgehop::sim
