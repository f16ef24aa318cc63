#include "sim/record/column_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "sim/config/input_error.h"
#include "sim/record/csv_table.h"

namespace hedgehop::sim {

void ColumnTable::add(std::string name, std::vector<double> numbers) {
  rows_ = numbers.size();
  names_.push_back(std::move(name));
  columns_.emplace_back(std::move(numbers));
}

void ColumnTable::add(std::string name, std::vector<std::string> words) {
  rows_ = words.size();
  names_.push_back(std::move(name));
  columns_.emplace_back(std::move(words));
}

template <class Values>
const Values& ColumnTable::column(std::string_view name) const {
  const auto found = std::ranges::find(names_, name);
  const auto refuse = [&](const std::string& why) {
    if (file_.empty()) throw std::runtime_error(why);
    throw InputError(file_ + ": " + why);
  };
  if (found == names_.end()) refuse(fmt::format("no column '{}'", name));
  const auto* const values = std::get_if<Values>(&columns_[static_cast<size_t>(found - names_.begin())]);
  if (!values) refuse(fmt::format("column '{}' has the wrong type", name));
  return *values;
}

const std::vector<double>& ColumnTable::numbers(std::string_view name) const {
  return column<std::vector<double>>(name);
}

const std::vector<std::string>& ColumnTable::words(std::string_view name) const {
  return column<std::vector<std::string>>(name);
}

std::string ColumnTable::csv() const {
  fmt::memory_buffer out;
  {
    CsvLine header(out);
    for (const std::string& name : names_) header.add(std::string_view(name));
  }
  for (size_t row = 0; row < rows_; ++row) {
    CsvLine line(out);
    for (const Column& column : columns_) {
      if (const auto* const numbers = std::get_if<std::vector<double>>(&column)) {
        line.add((*numbers)[row]);
      } else {
        line.add(std::string_view(std::get<std::vector<std::string>>(column)[row]));
      }
    }
  }
  return fmt::to_string(out);
}

ColumnTable read_columns(const std::filesystem::path& file, std::span<const std::string_view> words) {
  const CsvTable csv(file);
  ColumnTable table(file.string());
  for (const std::string& name : csv.names()) {
    if (std::ranges::find(words, name) != words.end()) {
      table.add(name, csv.words(name));
    } else {
      table.add(name, csv.numbers(name));
    }
  }
  return table;
}

}  // namespace hedgehop::sim
