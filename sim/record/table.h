#pragma once

#include <fmt/format.h>

#include <Eigen/Core>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "sim/flight/flight.h"

namespace hedgehop::sim {

/// Writes one line of comma-separated values. The destructor ends the line. Numbers have the shortest text that reads
/// back to the same double. NaN is an empty field.
class CsvLine {
 public:
  explicit CsvLine(fmt::memory_buffer& out) : out_(out) {}
  ~CsvLine() { out_.push_back('\n'); }
  CsvLine(const CsvLine&) = delete;
  CsvLine& operator=(const CsvLine&) = delete;

  CsvLine& add(double value) {
    separate();
    if (!std::isnan(value)) fmt::format_to(std::back_inserter(out_), "{}", value);
    return *this;
  }
  CsvLine& add(const std::optional<double>& value) { return add(value.value_or(NAN)); }
  CsvLine& add(const Eigen::Vector3d& v) { return add(v.x()).add(v.y()).add(v.z()); }
  /// Adds text, quoted if necessary (RFC 4180).
  CsvLine& add(std::string_view text) {
    separate();
    const bool quote = text.find_first_of(",\"\r\n") != std::string_view::npos;
    if (quote) out_.push_back('"');
    for (const char c : text) {
      if (c == '"') out_.push_back('"');
      out_.push_back(c);
    }
    if (quote) out_.push_back('"');
    return *this;
  }

 private:
  void separate() {
    if (!first_) out_.push_back(',');
    first_ = false;
  }
  fmt::memory_buffer& out_;
  bool first_ = true;
};

/// A table of named columns of equal length. A column holds numbers (NaN if unknown) or words.
class Table {
 public:
  struct Column {
    std::string name;
    std::variant<std::vector<double>, std::vector<std::string>> values;
    std::string unit = {};                ///< "" for none, or unknown
    std::optional<FigureKind> kind = {};  ///< of a figure of a flight
    bool whole = false;                   ///< all numbers are integers
  };

  Table() = default;
  /// Reads comma-separated values with a header line (RFC 4180), as csv() writes them. All columns are words; numbers()
  /// parses them. Throws InputError naming file and line for a row of the wrong width.
  explicit Table(const std::filesystem::path& file);

  /// Adds a column. Requires as many values as the columns before have.
  void add(Column column);
  void add(std::string name, std::vector<double> numbers) { add(Column{std::move(name), std::move(numbers)}); }
  void add(std::string name, std::vector<std::string> words) { add(Column{std::move(name), std::move(words)}); }

  /// Adds the rows of another table. Columns are joined by name; a new one follows the column before it in `more`.
  /// Missing values are empty. Both tables must have columns from add().
  void append(Table more);

  size_t rows() const { return rows_; }
  const std::vector<std::string>& names() const { return names_; }
  bool has(std::string_view name) const;
  /// Returns the columns that add() has added; empty for a table that was read from a file.
  const std::vector<Column>& columns() const { return columns_; }
  /// Returns a column that add() has added. Throws as numbers().
  const Column& column(std::string_view name) const;

  /// Returns a column as numbers; an empty field is NaN. Throws std::runtime_error naming the column if it is
  /// missing or a field is no number; for a table from a file, InputError naming file and line.
  std::vector<double> numbers(std::string_view name) const;
  /// Returns a column as words; a NaN is "". Throws as numbers() if it is missing.
  std::vector<std::string> words(std::string_view name) const;

  /// Returns the table as comma-separated values with a header line (RFC 4180). Numbers are the shortest that read back
  /// to the same double; NaN is an empty field.
  std::string csv() const;

 private:
  /// The text of a file, split into fields.
  struct Source {
    std::string file, text;
    std::vector<std::string_view> fields;  ///< into the text, row by row, with their quotes
    std::vector<size_t> lines;             ///< of each row in the file, from 1
  };
  friend Table read_columns(const std::filesystem::path& file, std::span<const std::string_view> words);
  size_t index_of(std::string_view name) const;
  [[noreturn]] void refuse(const std::string& why) const;
  double number(std::string_view field, size_t row, std::string_view name) const;

  std::shared_ptr<const Source> source_;  ///< of a table from a file
  bool parsed_ = true;                    ///< columns_ holds the columns; else the source does
  std::vector<std::string> names_;
  std::vector<Column> columns_;
  size_t rows_ = 0;
};

/// Reads a CSV file. @param words  names of its columns of words; all others are numbers.
/// Throws InputError naming file, line and column for a field that is no number.
Table read_columns(const std::filesystem::path& file, std::span<const std::string_view> words = {});

}  // namespace hedgehop::sim
