#pragma once

#include <cerrno>
#include <filesystem>
#include <string_view>

namespace hedgehop::sim {

/// Returns the result of a system call, which is repeated if a signal interrupts it.
template <class Call>
auto uninterrupted(Call call) {
  auto result = call();
  while (result < 0 && errno == EINTR) result = call();
  return result;
}

/// A file that is written piece by piece into a temporary file (`.part`) and renamed at the end, so that `file` is
/// complete or absent. An existing special file (/dev/stdout, a pipe) is written directly. All functions throw
/// std::runtime_error with the file and the cause (full disk, missing permission).
class StreamedFile {
 public:
  explicit StreamedFile(const std::filesystem::path& file);
  StreamedFile(const StreamedFile&) = delete;
  StreamedFile& operator=(const StreamedFile&) = delete;
  /// Removes the temporary file of a file that was not closed.
  ~StreamedFile();

  void write(std::string_view bytes);
  void close();

 private:
  [[noreturn]] void fail(int error);

  std::filesystem::path file_, part_;
  int descriptor_ = -1;
};

}  // namespace hedgehop::sim
