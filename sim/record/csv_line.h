#pragma once

#include <fmt/format.h>

#include <Eigen/Core>
#include <cmath>
#include <iterator>
#include <optional>
#include <string_view>

namespace hedgehop::sim {

/// One line of comma-separated values, as CsvTable reads them; it ends with its destruction. Numbers are the
/// shortest that read back to the same double, what is not known (NaN) an empty field.
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
  /// Quoted when it has to be (RFC 4180).
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

}  // namespace hedgehop::sim
