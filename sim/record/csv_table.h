#pragma once

#include <fmt/format.h>

#include <Eigen/Core>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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

/// A table of comma-separated values with a header line (RFC 4180).
class CsvTable {
 public:
  /// Reads `file`. Throws InputError with file and line of a fault, such as a row of the wrong width.
  explicit CsvTable(const std::filesystem::path& file);

  size_t rows() const { return first_lines_.size(); }
  const std::vector<std::string>& names() const { return names_; }
  /// Returns a column of numbers; NaN for an empty field. Throws InputError with file, line and column if the column is
  /// missing or a field is not a number.
  std::vector<double> numbers(std::string_view name) const;
  /// Returns a column of words. Throws InputError if it is missing.
  std::vector<std::string> words(std::string_view name) const;

 private:
  size_t column(std::string_view name) const;
  std::string_view field(size_t row, size_t column) const { return fields_[row * names_.size() + column]; }

  std::string file_, text_;
  std::vector<std::string> names_;
  std::vector<std::string_view> fields_;  ///< parts of text_, row-major, with their quotes
  std::vector<size_t> first_lines_;       ///< first line of each row, from 1
};

}  // namespace hedgehop::sim
