#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sim/config/input_error.h"

/// A configuration as written, with the position of every key and value, before any interpretation.
namespace hedgehop::sim {

/// Key that names the choice of a module, of another variant, and of a check (Field::selector). Overriding it by
/// another value replaces the whole map, because the other keys belong to the previous choice.
inline constexpr std::string_view kModuleSelector = "module";
inline constexpr std::string_view kSelectors[] = {"type", kModuleSelector, "check"};
/// Keys that choose an alternative by themselves (fields::ChosenByKey), instead of `module`.
inline constexpr std::string_view kPluginKey = "plugin", kPythonKey = "python";

struct Entry;

/// A scalar, a list or a map.
struct Node {
  static constexpr bool kIsOpen = true;  ///< as a field it holds any keys
  enum class Kind { null, scalar, list, map };

  Kind kind = Kind::null;
  SourcePosition position;
  std::string text;            ///< of a scalar
  bool quoted = false;         ///< a quoted scalar is text, even if it looks like a number
  std::vector<Node> items;     ///< of a list
  std::vector<Entry> entries;  ///< of a map, in the order of the file
  bool incomplete = false;     ///< a map without the keys of a used file that could not be read

  /// Returns the value of a key of this map, or null.
  const Node* find(std::string_view key) const;
  Node* find(std::string_view key);
  /// Returns its kind or value for messages: "'abc'", "a list", "a map", "an empty value".
  std::string description() const;
};

/// A key of a map and its value.
struct Entry {
  std::string key;
  SourcePosition position;
  Node value;
};

/// Returns the position of the deepest part of `path` that the input contains.
SourcePosition position_of(const Node& root, std::string_view path);

/// Parses one YAML document. Duplicate keys, merge keys, tags, several documents, an empty text and syntax errors go to
/// `errors`; aliases are copied. @param file  name for positions. @return the valid part, possibly null.
Node parse_yaml(const std::string& text, const std::string& file, ErrorList& errors);

}  // namespace hedgehop::sim
