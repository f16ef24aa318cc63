#include "sim/config/input_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "sim/fields/invalid_field.h"

namespace hedgehop::sim {
namespace {

std::string joined_lines(const std::vector<std::string>& lines) { return fmt::format("{}", fmt::join(lines, "\n")); }

std::vector<std::string> each_on_one_line(const std::vector<std::string>& lines) {
  std::vector<std::string> result;
  for (const std::string& line : lines) result.push_back(one_line(line));
  return result;
}

std::vector<std::string> texts(const std::vector<FieldError>& errors) {
  std::vector<std::string> lines;
  for (const FieldError& error : errors) lines.push_back(error.text());
  return lines;
}

}  // namespace

std::string SourcePosition::text() const { return line > 0 ? fmt::format("{}:{}:{}", file, line, column) : file; }

std::string FieldError::text() const { return path.empty() ? message : fmt::format("'{}': {}", path, message); }

FieldError field_error(const std::string& path, const std::invalid_argument& error) {
  const auto* const invalid = dynamic_cast<const fields::InvalidField*>(&error);
  if (!invalid) return {path, error.what()};
  return {join_path(path, invalid->key()), invalid->message()};
}

InputError::InputError(const std::vector<std::string>& lines)
    : std::runtime_error(joined_lines(each_on_one_line(lines))), lines_(each_on_one_line(lines)) {}

InputError::InputError(std::vector<FieldError> errors)
    : std::runtime_error(joined_lines(each_on_one_line(texts(errors)))),
      lines_(each_on_one_line(texts(errors))),
      field_errors_(std::move(errors)) {}

void ErrorList::add(const SourcePosition& position, std::string message) {
  if (++count_ <= kMaxStored) errors_.push_back({position, std::move(message)});
}

void ErrorList::throw_if_any() const {
  if (errors_.empty()) return;
  std::vector<std::string_view> files;
  for (const Positioned& error : errors_) {
    if (std::find(files.begin(), files.end(), error.position.file) == files.end()) files.push_back(error.position.file);
  }
  std::vector<std::string> lines;
  for (std::string_view file : files) {
    std::vector<const Positioned*> of_file;
    for (const Positioned& error : errors_) {
      if (error.position.file == file) of_file.push_back(&error);
    }
    std::stable_sort(of_file.begin(), of_file.end(), [](const Positioned* a, const Positioned* b) {
      return std::pair(a->position.line, a->position.column) < std::pair(b->position.line, b->position.column);
    });
    for (const Positioned* error : of_file) {
      std::string line = error->position.text() + ": " + error->message;
      if (std::find(lines.begin(), lines.end(), line) == lines.end()) lines.push_back(std::move(line));
    }
  }
  if (count_ > kMaxStored) lines.push_back(fmt::format("and {} more", count_ - kMaxStored));
  throw InputError(lines);
}

std::string ErrorList::path_text(std::string_view path) const {
  return path.empty() ? "the " + kind_ : fmt::format("'{}'", path);
}

namespace {

/// Returns the path with '*' in place of each index of a list item: "rows.3" gives "rows.*".
std::string without_indices(std::string_view path) {
  std::string pattern;
  while (!path.empty()) {
    const size_t dot = path.find('.');
    const std::string_view part = path.substr(0, dot);
    const bool is_index = !part.empty() && part.find_first_not_of("0123456789") == std::string_view::npos;
    pattern = join_path(pattern, is_index ? "*" : part);
    path = dot == std::string_view::npos ? std::string_view() : path.substr(dot + 1);
  }
  return pattern;
}

}  // namespace

std::string ErrorList::advice(std::string_view path, std::string_view key, std::string_view value,
                              const std::vector<std::string_view>& allowed) const {
  const std::string pattern = without_indices(path);
  for (const FormerKey& row : former_keys_) {
    const bool holds_here = row.beside.empty() || std::ranges::find(allowed, row.beside) != allowed.end();
    if (row.path == pattern && row.key == key && row.value == value && holds_here)
      return fmt::format("; {}", row.advice);
  }
  return suggestion(value.empty() ? key : value, allowed);
}

std::string join_path(std::string_view parent, std::string_view key) {
  if (parent.empty() || key.empty()) return std::string(parent.empty() ? key : parent);
  return fmt::format("{}.{}", parent, key);
}

std::string one_line(std::string_view text) {
  constexpr std::string_view kHex = "0123456789abcdef";
  std::string line;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte != 0x7f) {
      line += c;
    } else if (c == '\n') {
      line += "\\n";
    } else if (c == '\t') {
      line += "\\t";
    } else {
      line += {'\\', 'x', kHex[byte >> 4], kHex[byte & 15]};
    }
  }
  return line;
}

int edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<int>> d(a.size() + 1, std::vector<int>(b.size() + 1));
  for (size_t i = 0; i <= a.size(); ++i) {
    for (size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        d[i][j] = static_cast<int>(i + j);
        continue;
      }
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

std::string suggestion(std::string_view word, const std::vector<std::string_view>& allowed) {
  constexpr size_t kMaxWordLetters = 100;
  std::string_view nearest;
  int nearest_distance = 0;
  for (std::string_view candidate : allowed) {
    if (word.size() > kMaxWordLetters) break;
    const int distance = edit_distance(word, candidate);
    const size_t shorter = std::min(word.size(), candidate.size()), longer = std::max(word.size(), candidate.size());
    const bool same_start = shorter >= 3 && word.substr(0, shorter) == candidate.substr(0, shorter);
    const bool near = same_start || static_cast<size_t>(distance) * 3 <= longer;
    if (near && (nearest.empty() || distance < nearest_distance)) {
      nearest = candidate;
      nearest_distance = distance;
    }
  }
  const std::string guess = nearest.empty() ? "; " : fmt::format("; did you mean '{}'? ", nearest);
  return fmt::format("{}allowed: {}", guess, allowed.empty() ? "none" : fmt::format("{}", fmt::join(allowed, ", ")));
}

}  // namespace hedgehop::sim
