#include "sim/record/csv_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "sim/config/input_error.h"
#include "sim/record/whole_file.h"

namespace hedgehop::sim {
namespace {

/// Removes the next record from `rest` and splits it at commas. A line break inside quotes belongs to its field (RFC
/// 4180). Returns the number of lines of the record.
size_t take_record(std::string_view& rest, std::vector<std::string_view>& fields) {
  size_t begin = 0, lines = 1;
  bool quoted = false;
  for (size_t i = 0;; ++i) {
    const bool at_end = i == rest.size();
    if (!at_end && rest[i] == '"') quoted = !quoted;
    if (!at_end && rest[i] == '\n' && quoted) ++lines;
    const bool ends_record = at_end || (rest[i] == '\n' && !quoted);
    if (!ends_record && (rest[i] != ',' || quoted)) continue;
    std::string_view field = rest.substr(begin, i - begin);
    if (ends_record && field.ends_with('\r')) field.remove_suffix(1);
    fields.push_back(field);
    begin = i + 1;
    if (!ends_record) continue;
    rest.remove_prefix(at_end ? i : i + 1);
    return lines;
  }
}

std::string unquoted(std::string_view field) {
  if (field.size() < 2 || field.front() != '"') return std::string(field);
  std::string word;
  for (size_t i = 1; i + 1 < field.size(); ++i) {
    word.push_back(field[i]);
    if (field[i] == '"') ++i;  // a doubled quote
  }
  return word;
}

}  // namespace

CsvTable::CsvTable(const std::filesystem::path& file) : file_(file.string()), text_(read_file_whole(file)) {
  std::string_view rest = text_;
  for (size_t number = 1, lines = 0; !rest.empty(); number += lines) {
    std::vector<std::string_view> fields;
    lines = take_record(rest, fields);
    if (number == 1) {
      for (const std::string_view name : fields) names_.push_back(unquoted(name));
      continue;
    }
    if (fields.size() != names_.size()) {
      throw InputError(fmt::format("{}:{}: {} fields; the header has {}", file_, number, fields.size(), names_.size()));
    }
    fields_.insert(fields_.end(), fields.begin(), fields.end());
    first_lines_.push_back(number);
  }
  if (names_.empty()) throw InputError(fmt::format("{}: no header line", file_));
}

size_t CsvTable::column(std::string_view name) const {
  const auto found = std::ranges::find(names_, name);
  if (found == names_.end()) throw InputError(fmt::format("{}: no column '{}'", file_, name));
  return static_cast<size_t>(found - names_.begin());
}

std::vector<double> CsvTable::numbers(std::string_view name) const {
  const size_t c = column(name);
  std::vector<double> values(rows(), NAN);
  for (size_t r = 0; r < rows(); ++r) {
    const std::string_view text = field(r, c);
    if (text.empty()) continue;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), values[r]);
    if (error != std::errc() || end != text.data() + text.size()) {
      throw InputError(fmt::format("{}:{}: '{}' in column '{}' is not a number", file_, first_lines_[r], text, name));
    }
  }
  return values;
}

std::vector<std::string> CsvTable::words(std::string_view name) const {
  const size_t c = column(name);
  std::vector<std::string> words;
  words.reserve(rows());
  for (size_t r = 0; r < rows(); ++r) words.push_back(unquoted(field(r, c)));
  return words;
}

}  // namespace hedgehop::sim
