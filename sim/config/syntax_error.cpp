#include "sim/config/syntax_error.h"

#include <fmt/format.h>
#include <yaml-cpp/exceptions.h>

#include <algorithm>

#include "sim/fields/utf8_mark.h"

namespace hedgehop::sim {
namespace {

namespace msg = YAML::ErrorMsg;

constexpr std::string_view kBlank = " \t\r";

/// Returns a line, from 1, without its line break; empty behind the end.
std::string_view line_of(std::string_view text, int line) {
  text = without_utf8_mark(text);
  for (int i = 1; i < line; ++i) {
    const size_t end = text.find('\n');
    if (end == std::string_view::npos) return {};
    text.remove_prefix(end + 1);
  }
  return text.substr(0, text.find('\n'));
}

bool is_blank(std::string_view text) { return text.find_first_not_of(kBlank) == std::string_view::npos; }

bool ends_key(std::string_view text) { return text.find(": ") != std::string_view::npos || text.ends_with(':'); }

/// The line of an error, cut at its place.
struct Place {
  std::string_view line_before, before, from;  ///< the line above, the part left of the place, the rest

  char sign() const { return from.empty() ? '\n' : from.front(); }
  char sign_before() const {
    const size_t last = before.find_last_not_of(kBlank);
    return last == std::string_view::npos ? '\n' : before[last];
  }
};

/// A ':' that gives no key a value.
std::string unexpected_colon(const Place& place) {
  if (ends_key(place.before)) return "a second ': ' in this value; put the value in quotes";
  return ends_key(place.line_before) ? "unexpected ':'; is this line indented too far?"
                                     : "unexpected ':'; does the line before lack a colon?";
}

/// A list or map in brackets that has no end.
std::string unclosed(const Place& place, bool is_map, const SyntaxError& error) {
  if (is_map && place.sign() == ':' && ends_key(place.before)) return unexpected_colon(place);
  // The library stops at the list itself if the text ends without a line break.
  const bool is_at_end = is_blank(place.from) || error.position.text() == error.container.text();
  const bool may_lack_comma = place.sign() != ':' && !is_at_end;
  const char end = is_map ? '}' : ']';
  const int begin = error.container.line;
  return fmt::format("{}'{}' is missing{}", may_lack_comma ? "',' or " : "", end,
                     begin > 0 && begin < error.position.line
                         ? fmt::format("; the {} begins in line {}", is_map ? "map" : "list", begin)
                         : "");
}

/// Text that continues no list and no map.
std::string surplus(const Place& place) {
  const char before = place.sign_before();
  if (before == '"' || before == '\'') return "text after the end of a quoted value";
  if (before == ']' || before == '}') return fmt::format("text after the '{}' that ends a value", before);
  if (is_blank(place.before)) return "this line continues no list and no map above; is its indentation wrong?";
  return place.sign() == ',' ? "a value must not begin with ','; put it in quotes" : "text after the end of a value";
}

std::string cause_of(const Place& place, const SyntaxError& error) {
  const std::string& message = error.message;
  if (message == msg::TAB_IN_INDENTATION) return "a tab in the indentation; use spaces";
  if (message == msg::MAP_VALUE) return unexpected_colon(place);
  if (message == msg::END_OF_MAP_FLOW) return unclosed(place, true, error);
  if (message == msg::END_OF_SEQ_FLOW) return unclosed(place, false, error);
  if (message == msg::END_OF_MAP || message == msg::END_OF_SEQ) return surplus(place);
  if (message == msg::EOF_IN_SCALAR) return "the closing quote is missing";
  if (message == msg::FLOW_END) return fmt::format("'{}' without the bracket that it closes", place.sign());
  if (message == msg::BLOCK_ENTRY) return "a list item '- ' must begin its own line; '[a, b]' is a list on one line";
  if (message == msg::UNKNOWN_TOKEN) {
    return fmt::format("a value must not begin with '{}'; put it in quotes", place.sign());
  }
  if (message == msg::UNKNOWN_ANCHOR || message == msg::ALIAS_NOT_FOUND) {
    return "'*' names no anchor above; put a value that begins with '*' in quotes";
  }
  if (message == msg::ANCHOR_NOT_FOUND) return "'&' names no anchor; put a value that begins with '&' in quotes";
  return message;
}

}  // namespace

void add_syntax_error(std::string_view text, SyntaxError error, ErrorList& errors) {
  const std::string_view line = line_of(text, error.position.line);
  const std::string_view indentation = line.substr(0, line.find_first_not_of(kBlank));
  // The library also stops behind a tab, at the ':'. Inside brackets, tabs are valid.
  const bool is_in_block =
      error.message == msg::MAP_VALUE || error.message == msg::END_OF_MAP || error.message == msg::BLOCK_ENTRY;
  if (const size_t tab = indentation.find('\t'); is_in_block && tab != std::string_view::npos) {
    error.position.column = static_cast<int>(tab) + 1;
    error.message = msg::TAB_IN_INDENTATION;
  }
  const size_t column = std::min(line.size(), static_cast<size_t>(std::max(0, error.position.column - 1)));
  const Place place{line_of(text, error.position.line - 1), line.substr(0, column), line.substr(column)};
  errors.add(error.position, cause_of(place, error));
}

}  // namespace hedgehop::sim
