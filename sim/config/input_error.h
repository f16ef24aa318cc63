#pragma once

#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

/// Errors in input that its author can correct, with their positions.
namespace hedgehop::sim {

/// Position of a key or value in the input.
struct SourcePosition {
  std::string file;          ///< as the user named it, or "--set key.path"
  int line = 0, column = 0;  ///< from 1; 0 if only `file` is known

  /// Returns "file:line:column", or "file" if no line is known.
  std::string text() const;
};

/// An error in the value of one field.
struct FieldError {
  std::string path;  ///< dotted, from the root, such as "checks.0.max"; empty for the whole file
  std::string message;

  /// Returns "'path': message", or the message alone if the path is empty.
  std::string text() const;
};

/// Returns the error of a config that a library refuses. fields::InvalidField extends the path by its key.
/// @param path  of the config, dotted, from the root.
FieldError field_error(const std::string& path, const std::invalid_argument& error);

/// Invalid input: every error found. Only the command line catches it.
class InputError : public std::runtime_error {
 public:
  /// @param lines  complete messages, one error each.
  explicit InputError(const std::vector<std::string>& lines);
  explicit InputError(const std::string& line) : InputError(std::vector<std::string>{line}) {}
  /// Errors without positions; at_positions() adds them.
  explicit InputError(std::vector<FieldError> errors);
  explicit InputError(FieldError error) : InputError(std::vector<FieldError>{std::move(error)}) {}

  /// One line per error, `file:line:column: message` if the position is known, in the order of the file.
  const std::vector<std::string>& errors() const { return lines_; }
  /// The errors that have no positions yet; empty if errors() is complete.
  const std::vector<FieldError>& field_errors() const { return field_errors_; }

 private:
  std::vector<std::string> lines_;
  std::vector<FieldError> field_errors_;
};

/// A key, or a value of a key, that an earlier version accepted.
struct FormerKey {
  std::string_view path, key;    ///< key of the map at `path`, which has '*' for the index of a list item: "rows.*"
  std::string_view value = "";   ///< the former value; empty if the key itself changed
  std::string_view beside = "";  ///< the row holds for maps that allow this key; empty for all
  std::string_view advice;       ///< "its name is now 'renderer'"
};

/// Collects errors with positions. It stores the first fifty and counts the others.
class ErrorList {
 public:
  /// @param kind  of the file, for messages: "scenario", "campaign". @param former_keys  that its reader explains; they
  /// outlive the list.
  explicit ErrorList(std::string_view kind, std::span<const FormerKey> former_keys = {})
      : kind_(kind), former_keys_(former_keys) {}

  void add(const SourcePosition& position, std::string message);
  bool empty() const { return count_ == 0; }
  size_t count() const { return count_; }
  /// Returns the message that was added first, without its position. Must not be empty.
  const std::string& first_message() const { return errors_.front().message; }
  /// Throws InputError with all errors, grouped by file, each file from top to bottom. Has no effect if empty.
  void throw_if_any() const;

  std::string_view kind() const { return kind_; }
  /// Returns "'a.b'", or "the campaign" for the empty path.
  std::string path_text(std::string_view path) const;
  /// Returns "; " and the advice for a former key or value, or the suggestion() of an allowed one.
  /// @param value  of the key; empty if the key is unknown.
  std::string advice(std::string_view path, std::string_view key, std::string_view value,
                     const std::vector<std::string_view>& allowed) const;

 private:
  struct Positioned {
    SourcePosition position;
    std::string message;
  };
  static constexpr size_t kMaxStored = 50;
  std::string kind_;
  std::span<const FormerKey> former_keys_;
  std::vector<Positioned> errors_;
  size_t count_ = 0;
};

/// Returns a dotted path: "a.b" and "c" give "a.b.c"; an empty part is left out.
std::string join_path(std::string_view parent, std::string_view key);

/// Returns the text on one line: control characters become escapes, because quoted names may contain line breaks.
std::string one_line(std::string_view text);

/// Returns the number of letters to insert, delete, replace or swap with their neighbor to turn `a` into `b`.
int edit_distance(std::string_view a, std::string_view b);

/// Returns "; did you mean 'x'? allowed: x, y"; the guess only if a word is close.
std::string suggestion(std::string_view word, const std::vector<std::string_view>& allowed);

}  // namespace hedgehop::sim
