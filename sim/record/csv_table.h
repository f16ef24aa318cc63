#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace hedgehop::sim {

/// A table of comma-separated values with a header line, as CsvLine writes it (RFC 4180).
class CsvTable {
 public:
  /// Reads `file`. Throws std::runtime_error naming file and line for what cannot be read or a row of the wrong width.
  explicit CsvTable(const std::filesystem::path& file);

  size_t rows() const { return first_lines_.size(); }
  const std::vector<std::string>& names() const { return names_; }
  /// A column of numbers, NaN where the field is empty. Throws std::runtime_error naming file, line and column when
  /// the column is missing or a field is no number.
  std::vector<double> numbers(std::string_view name) const;
  /// A column of words; throws when it is missing.
  std::vector<std::string> words(std::string_view name) const;

 private:
  size_t column(std::string_view name) const;
  std::string_view field(size_t row, size_t column) const { return fields_[row * names_.size() + column]; }

  std::string file_, text_;
  std::vector<std::string> names_;
  std::vector<std::string_view> fields_;  ///< into text_, row by row, quotes still on
  std::vector<size_t> first_lines_;       ///< of each row in the file, from 1
};

}  // namespace hedgehop::sim
