#include "sim/record/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "sim/config/input_error.h"
#include "sim/config/whole_file.h"
#include "sim/fields/utf8_mark.h"

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

Table::Table(const std::filesystem::path& file) : parsed_(false) {
  auto source = std::make_shared<Source>(Source{.file = file.string(), .text = read_file_whole(file)});
  std::string_view rest = without_utf8_mark(source->text);
  for (size_t number = 1, lines = 0; !rest.empty(); number += lines) {
    std::vector<std::string_view> fields;
    lines = take_record(rest, fields);
    if (number == 1) {
      for (const std::string_view name : fields) names_.push_back(unquoted(name));
      continue;
    }
    if (fields.size() != names_.size()) {
      throw InputError(
          fmt::format("{}:{}: {} fields; the header has {}", source->file, number, fields.size(), names_.size()));
    }
    source->fields.insert(source->fields.end(), fields.begin(), fields.end());
    source->lines.push_back(number);
  }
  if (names_.empty()) throw InputError(fmt::format("{}: no header line", source->file));
  rows_ = source->lines.size();
  source_ = std::move(source);
}

void Table::add(Column column) {
  rows_ = std::visit([](const auto& values) { return values.size(); }, column.values);
  names_.push_back(column.name);
  columns_.push_back(std::move(column));
}

void Table::append(Table more) {
  const size_t rows = rows_ + more.rows_;
  const auto as_words = [](Column& column) {
    Table one;
    one.add(column);
    column.values = one.words(column.name);
    column.whole = false;
  };
  size_t at = 0;
  for (Column& column : more.columns_) {
    auto own = std::ranges::find(columns_, column.name, &Column::name);
    if (own == columns_.end()) {
      Column empty{.name = column.name, .values = {}, .unit = column.unit, .kind = column.kind, .whole = column.whole};
      if (std::holds_alternative<std::vector<double>>(column.values)) {
        empty.values = std::vector<double>(rows_, NAN);
      } else {
        empty.values = std::vector<std::string>(rows_);
      }
      names_.insert(names_.begin() + static_cast<std::ptrdiff_t>(at), column.name);
      own = columns_.insert(columns_.begin() + static_cast<std::ptrdiff_t>(at), std::move(empty));
    }
    at = static_cast<size_t>(own - columns_.begin()) + 1;
    if (own->values.index() != column.values.index()) {
      as_words(*own);
      as_words(column);
    }
    own->whole = own->whole && column.whole;
    std::visit(
        [&]<class Values>(Values& values) {
          auto& added = std::get<Values>(column.values);
          std::move(added.begin(), added.end(), std::back_inserter(values));
        },
        own->values);
  }
  for (Column& column : columns_) {  // that `more` lacks
    if (auto* const numbers = std::get_if<std::vector<double>>(&column.values)) numbers->resize(rows, NAN);
    if (auto* const words = std::get_if<std::vector<std::string>>(&column.values)) words->resize(rows);
  }
  rows_ = rows;
}

bool Table::has(std::string_view name) const { return std::ranges::find(names_, name) != names_.end(); }

void Table::refuse(const std::string& why) const {
  if (!source_) throw std::runtime_error(why);
  throw InputError(fmt::format("{}: {}", source_->file, why));
}

size_t Table::index_of(std::string_view name) const {
  const auto found = std::ranges::find(names_, name);
  if (found == names_.end()) refuse(fmt::format("no column '{}'", name));
  return static_cast<size_t>(found - names_.begin());
}

const Table::Column& Table::column(std::string_view name) const { return columns_.at(index_of(name)); }

double Table::number(std::string_view field, size_t row, std::string_view name) const {
  if (field.empty()) return NAN;
  double value = NAN;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error == std::errc() && end == field.data() + field.size()) return value;
  const std::string why = fmt::format("'{}' in column '{}' is not a number", field, name);
  if (!source_) throw std::runtime_error(why);
  throw InputError(fmt::format("{}:{}: {}", source_->file, source_->lines[row], why));
}

std::vector<double> Table::numbers(std::string_view name) const {
  const size_t c = index_of(name);
  if (parsed_) {
    if (const auto* const numbers = std::get_if<std::vector<double>>(&columns_[c].values)) return *numbers;
  }
  std::vector<double> values;
  values.reserve(rows_);
  for (size_t row = 0; row < rows_; ++row) {
    const std::string_view field = parsed_
                                       ? std::string_view(std::get<std::vector<std::string>>(columns_[c].values)[row])
                                       : source_->fields[row * names_.size() + c];
    values.push_back(number(field, row, name));
  }
  return values;
}

std::vector<std::string> Table::words(std::string_view name) const {
  const size_t c = index_of(name);
  if (parsed_) {
    if (const auto* const words = std::get_if<std::vector<std::string>>(&columns_[c].values)) return *words;
  }
  std::vector<std::string> words;
  words.reserve(rows_);
  for (size_t row = 0; row < rows_; ++row) {
    if (!parsed_) {
      words.push_back(unquoted(source_->fields[row * names_.size() + c]));
      continue;
    }
    const double value = std::get<std::vector<double>>(columns_[c].values)[row];
    words.push_back(std::isnan(value) ? "" : fmt::format("{}", value));
  }
  return words;
}

std::string Table::csv() const {
  fmt::memory_buffer out;
  {
    CsvLine header(out);
    for (const std::string& name : names_) header.add(std::string_view(name));
  }
  for (size_t row = 0; row < rows_; ++row) {
    CsvLine line(out);
    for (const Column& column : columns_) {
      if (const auto* const numbers = std::get_if<std::vector<double>>(&column.values)) {
        line.add((*numbers)[row]);
      } else {
        line.add(std::string_view(std::get<std::vector<std::string>>(column.values)[row]));
      }
    }
  }
  return fmt::to_string(out);
}

Table read_columns(const std::filesystem::path& file, std::span<const std::string_view> words) {
  const Table read(file);
  Table table;
  for (const std::string& name : read.names()) {
    if (std::ranges::find(words, name) != words.end()) {
      table.add(name, read.words(name));
    } else {
      table.add(name, read.numbers(name));
    }
  }
  table.rows_ = read.rows_;
  table.source_ = std::make_shared<const Table::Source>(Table::Source{.file = file.string()});
  return table;
}

}  // namespace hedgehop::sim
