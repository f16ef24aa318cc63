#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace hedgehop::sim {

/// A table in memory: named columns of equal length, each with numbers (NaN if unknown) or words.
class ColumnTable {
 public:
  ColumnTable() = default;
  /// @param file  name of the source file, for messages.
  explicit ColumnTable(std::string file) : file_(std::move(file)) {}

  void add(std::string name, std::vector<double> numbers);
  void add(std::string name, std::vector<std::string> words);

  size_t rows() const { return rows_; }
  const std::vector<std::string>& names() const { return names_; }
  /// Returns a column of numbers or words. Throws std::runtime_error that names the column if it is missing or of the
  /// other kind; InputError that also names the file if the table was read from a file.
  const std::vector<double>& numbers(std::string_view name) const;
  const std::vector<std::string>& words(std::string_view name) const;

  /// Returns the table as comma-separated values with a header line (RFC 4180). Numbers have the shortest text that
  /// reads back to the same double. NaN is an empty field.
  std::string csv() const;

 private:
  using Column = std::variant<std::vector<double>, std::vector<std::string>>;
  template <class Values>
  const Values& column(std::string_view name) const;

  std::string file_;
  std::vector<std::string> names_;
  std::vector<Column> columns_;
  size_t rows_ = 0;
};

/// Reads a CSV file. @param words  names of the columns of words; all others are numbers.
/// Throws InputError with file, line and column of a fault.
ColumnTable read_columns(const std::filesystem::path& file, std::span<const std::string_view> words = {});

}  // namespace hedgehop::sim
