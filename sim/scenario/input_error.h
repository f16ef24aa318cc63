#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace hedgehop::sim {

/// Input that its author can fix: every fault found, each with its place. Only the command line catches it.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<std::string> faults) : std::runtime_error(join(faults)), faults_(std::move(faults)) {}
  explicit InputError(std::string fault) : InputError(std::vector<std::string>{std::move(fault)}) {}

  /// One line each, `file:line:column: what is wrong`, in the order of the file.
  const std::vector<std::string>& faults() const { return faults_; }

 private:
  static std::string join(const std::vector<std::string>& faults) {
    std::string lines;
    for (const std::string& fault : faults) lines += (lines.empty() ? "" : "\n") + fault;
    return lines;
  }
  std::vector<std::string> faults_;
};

}  // namespace hedgehop::sim
