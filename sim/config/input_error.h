#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hedgehop::sim {

/// The text with its control characters written out: names and values that a fault quotes may hold line breaks.
inline std::string one_line(std::string_view text) {
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

/// Input that its author can fix: every fault found, each with its place. Only the command line catches it.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<std::string> faults) : InputError(Lines(std::move(faults))) {}
  explicit InputError(std::string fault) : InputError(std::vector<std::string>{std::move(fault)}) {}

  /// One line each, `file:line:column: what is wrong`, in the order of the file.
  const std::vector<std::string>& faults() const { return faults_; }

 private:
  struct Lines {
    explicit Lines(std::vector<std::string> faults) : lines(std::move(faults)) {
      for (std::string& line : lines) line = one_line(line);
    }
    std::vector<std::string> lines;
  };
  explicit InputError(Lines faults) : std::runtime_error(join(faults.lines)), faults_(std::move(faults.lines)) {}

  static std::string join(const std::vector<std::string>& faults) {
    std::string lines;
    for (const std::string& fault : faults) lines += (lines.empty() ? "" : "\n") + fault;
    return lines;
  }
  std::vector<std::string> faults_;
};

}  // namespace hedgehop::sim
