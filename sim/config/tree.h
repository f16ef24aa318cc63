#pragma once

#include <string>
#include <string_view>
#include <vector>

/// A configuration as written, with the place of every key and value; nothing in it is interpreted yet.
namespace hedgehop::sim {

/// Where something was written.
struct Place {
  std::string file;          ///< as the user named it, or "--set key.path"
  int line = 0, column = 0;  ///< from 1; 0 when `file` alone is the place

  /// "file:line:column", or "file" alone.
  std::string text() const;
};

inline constexpr std::string_view kModuleSelector = "module";
/// Keys whose value names the choice of a variant (Field::selector). Overriding such a key by another value replaces
/// the whole map, because its other keys belong to the previous choice.
inline constexpr std::string_view kSelectors[] = {"type", kModuleSelector, "check"};
/// Keys that choose an alternative by themselves (fields::ChosenByKey) instead of `module`.
inline constexpr std::string_view kPluginKey = "plugin", kPythonKey = "python";

struct Entry;

/// A scalar, a list or a map.
struct Node {
  static constexpr bool kIsOpen = true;  ///< as a field it holds any keys
  enum class Kind { null, scalar, list, map };

  Kind kind = Kind::null;
  Place place;
  std::string text;            ///< of a scalar
  bool quoted = false;         ///< a scalar in quotes is text, whatever it looks like
  std::vector<Node> items;     ///< of a list
  std::vector<Entry> entries;  ///< of a map, in the order of the file
  bool incomplete = false;     ///< a map that lacks what a file would have given that could not be read

  /// Value of a key of this map, or null.
  const Node* find(std::string_view key) const;
  Node* find(std::string_view key);
  /// What it is, for messages: "'abc'", "a list", "a map", "nothing".
  std::string words() const;
};

/// A key of a map and its value.
struct Entry {
  std::string key;
  Place place;
  Node value;
};

/// Faults found so far; beyond the first fifty they are only counted.
class Faults {
 public:
  void add(const Place& place, std::string message);
  bool empty() const { return count_ == 0; }
  size_t count() const { return count_; }
  /// Throws InputError with all faults, file by file in the order of their first fault, each file from top to bottom;
  /// does nothing without faults.
  void raise() const;

 private:
  struct Fault {
    Place place;
    std::string message;
  };
  static constexpr size_t kMost = 50;
  std::vector<Fault> faults_;
  size_t count_ = 0;
};

/// "a.b" and "c" make "a.b.c"; an empty parent is the root.
std::string join_path(std::string_view parent, std::string_view key);

/// For messages: "'a.b'", or "the scenario" for the empty path.
std::string path_words(std::string_view path);

/// Place of the deepest part of `path` that was written at all.
Place place_of(const Node& root, std::string_view path);

/// Number of letters to insert, delete, replace or swap with their neighbor to turn `a` into `b`.
int edit_distance(std::string_view a, std::string_view b);

/// "; did you mean 'x'? allowed: x, y", the guess only when one is close.
std::string suggestion(std::string_view word, const std::vector<std::string_view>& allowed);

}  // namespace hedgehop::sim
