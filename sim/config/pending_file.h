#pragma once

#include <cerrno>
#include <filesystem>

namespace hedgehop::sim {

/// Returns the result of a system call, which is repeated if a signal interrupts it.
template <class Call>
auto uninterrupted(Call call) {
  auto result = call();
  while (result < 0 && errno == EINTR) result = call();
  return result;
}

/// A file that has its name only once it is complete. Until then it has no name, so that a killed process
/// leaves no file. On file systems without such files (O_TMPFILE: NFS, FAT), without /proc, and for the moment in which
/// it replaces an existing file, its name is `file`.part. An existing special file (/dev/stdout, a pipe) is opened as
/// it is. All functions throw std::system_error with the cause alone (full disk, missing permission).
class PendingFile {
 public:
  explicit PendingFile(const std::filesystem::path& file);
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;
  /// Discards the file.
  ~PendingFile();

  /// Open for writing until publish() or discard().
  int descriptor() const { return descriptor_; }
  /// Returns a path that opens the file again in this process.
  std::filesystem::path path() const;
  /// Gives the file its name, in place of an existing file, and closes it. Discards it if that fails.
  void publish();
  /// Removes the file unless it is published.
  void discard();

 private:
  enum class Kind { unnamed, named, special };
  int name_unnamed() const;
  int close();

  std::filesystem::path file_, part_;
  Kind kind_ = Kind::unnamed;
  int descriptor_ = -1;
};

}  // namespace hedgehop::sim
