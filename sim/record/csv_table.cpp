#include "sim/record/csv_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "sim/record/whole_file.h"

namespace hedgehop::sim {
namespace {

/// Splits a line at its commas outside quotes.
void split(std::string_view line, std::vector<std::string_view>& fields) {
  size_t begin = 0;
  bool quoted = false;
  for (size_t i = 0; i <= line.size(); ++i) {
    if (i < line.size() && line[i] == '"') quoted = !quoted;
    if (i == line.size() || (line[i] == ',' && !quoted)) {
      fields.push_back(line.substr(begin, i - begin));
      begin = i + 1;
    }
  }
}

std::string unquoted(std::string_view field) {
  if (field.size() < 2 || field.front() != '"') return std::string(field);
  std::string word;
  for (size_t i = 1; i + 1 < field.size(); ++i) {
    word.push_back(field[i]);
    if (field[i] == '"') ++i;  // doubled
  }
  return word;
}

}  // namespace

CsvTable::CsvTable(const std::filesystem::path& file) : file_(file.string()), text_(read_file_whole(file)) {
  std::string_view rest = text_;
  for (size_t number = 1; !rest.empty(); ++number) {
    const size_t end = rest.find('\n');
    std::string_view line = rest.substr(0, end);
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);

    std::vector<std::string_view> fields;
    split(line, fields);
    if (number == 1) {
      for (const std::string_view name : fields) names_.push_back(unquoted(name));
      continue;
    }
    if (fields.size() != names_.size()) {
      throw std::runtime_error(
          fmt::format("{}:{}: {} fields where the header has {}", file_, number, fields.size(), names_.size()));
    }
    fields_.insert(fields_.end(), fields.begin(), fields.end());
    ++rows_;
  }
  if (names_.empty()) throw std::runtime_error(fmt::format("{}: no header line", file_));
}

size_t CsvTable::column(std::string_view name) const {
  const auto found = std::ranges::find(names_, name);
  if (found == names_.end()) throw std::runtime_error(fmt::format("{}: no column '{}'", file_, name));
  return static_cast<size_t>(found - names_.begin());
}

std::vector<double> CsvTable::numbers(std::string_view name) const {
  const size_t c = column(name);
  std::vector<double> values(rows_, NAN);
  for (size_t r = 0; r < rows_; ++r) {
    const std::string_view text = field(r, c);
    if (text.empty()) continue;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), values[r]);
    if (error != std::errc() || end != text.data() + text.size()) {
      throw std::runtime_error(fmt::format("{}:{}: '{}' in column '{}' is no number", file_, r + 2, text, name));
    }
  }
  return values;
}

std::vector<std::string> CsvTable::words(std::string_view name) const {
  const size_t c = column(name);
  std::vector<std::string> words;
  words.reserve(rows_);
  for (size_t r = 0; r < rows_; ++r) words.push_back(unquoted(field(r, c)));
  return words;
}

}  // namespace hedgehop::sim
