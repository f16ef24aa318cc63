#pragma once

#include <optional>
#include <string>
#include <string_view>

/// The text of OBJ and MTL files: lines of a keyword and words.
namespace hedgehop::scenes::mesh {

/// Returns a text without the spaces at both ends.
std::string_view trimmed(std::string_view text);

/// Removes the first word of a text and returns it; empty at the end of the text.
std::string_view take_word(std::string_view& text);

/// Returns the number that a word is; nullopt for another word. A number too large for a double is infinite. NaN also
/// in the notation of Microsoft's C library, such as "-1.#IND".
std::optional<double> number_of(std::string_view word);

/// Calls `visit` with the keyword, the rest and the number, from 1, of each line that is not a comment. A backslash at
/// the end of a line continues it.
template <class Visit>
void for_each_line(std::string_view text, const Visit& visit) {
  const char ending = text.find('\n') == std::string_view::npos ? '\r' : '\n';
  std::string joined;
  for (size_t number = 1; !text.empty(); ++number) {
    const size_t end = text.find(ending);
    std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (line.ends_with('\\')) {
      line.remove_suffix(1);
      if (!text.empty()) {
        joined.append(line) += ' ';
        continue;
      }
      line = trimmed(line);  // the last line has no other to continue it
    }
    if (!joined.empty()) line = joined += line;
    if (!line.starts_with('#')) {
      const std::string_view keyword = take_word(line);
      visit(keyword, line, number);
    }
    joined.clear();
  }
}

}  // namespace hedgehop::scenes::mesh
