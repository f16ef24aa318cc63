#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

namespace hedgehop::sim {

/// Exclusive use of a folder for results, until the object or the process ends. It is a lock of the kernel on the file
/// `.hedgehop.lock`, so a process that is killed leaves no lock behind.
class FolderLock {
 public:
  /// Creates the folder if necessary. Throws InputError with the other process if the folder is in use, or
  /// if the file cannot be created.
  explicit FolderLock(const std::filesystem::path& folder);
  /// As above, for a named part of the folder, such as a shard: different parts may be in use at the same time, but not
  /// together with the whole folder.
  FolderLock(const std::filesystem::path& folder, std::string_view part);
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  /// Removes the files, and the folders that the constructor created if they are empty.
  ~FolderLock();

 private:
  struct Held {
    std::filesystem::path file;
    int descriptor = -1;
    bool alone = true;  ///< exclusive
  };
  void make_folder();
  void hold(const std::filesystem::path& file, bool alone);
  void release();

  std::filesystem::path folder_;
  std::vector<std::filesystem::path> made_;  ///< folders, outermost first
  std::vector<Held> held_;
};

}  // namespace hedgehop::sim
