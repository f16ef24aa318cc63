#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "sim/config/pending_file.h"

namespace hedgehop::sim {

/// A file that is written piece by piece and is absent until close(): see PendingFile. All functions throw
/// std::runtime_error with the file and the cause (full disk, missing permission).
class StreamedFile {
 public:
  explicit StreamedFile(const std::filesystem::path& file);

  void write(std::string_view bytes);
  void close();

 private:
  template <class Action>
  void guarded(Action action);
  void require_open() const;

  std::filesystem::path file_;
  std::optional<PendingFile> pending_;
};

}  // namespace hedgehop::sim
