#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>

#include "sim/plugin/channel.h"

namespace hedgehop::sim {

/// A copy of this process that works on its own: in another folder, with its own output (`module.log` in that folder),
/// and without the files and signal handlers of this process. It has a channel to this process and shared memory.
class IsolatedProcess {
 public:
  /// The work of the copy, which ends when it returns. @param memory  file of the shared memory.
  using Work = std::function<void(Channel& channel, int memory)>;

  /// @param folder  working folder, made if necessary; empty: a temporary one. Throws std::system_error if the process
  /// cannot be started.
  IsolatedProcess(const std::filesystem::path& folder, const Work& work);
  /// Ends the process. A temporary folder is removed, and another one if it is empty.
  ~IsolatedProcess();
  IsolatedProcess(const IsolatedProcess&) = delete;
  IsolatedProcess& operator=(const IsolatedProcess&) = delete;

  Channel& channel() { return channel_; }
  int memory() const { return memory_.descriptor; }

  /// Ends the process with all its children and closes the channel; returns its wait status, 0 after an earlier call. A
  /// process that closed the channel itself gets a moment to end, so that the status is its own.
  int stop();

 private:
  class Folder {
   public:
    explicit Folder(const std::filesystem::path& folder);
    ~Folder();
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    const std::filesystem::path& path() const { return folder_; }

   private:
    std::filesystem::path folder_;
    bool is_temporary_;
  };
  struct Memory {
    Memory();
    ~Memory();
    Memory(const Memory&) = delete;
    Memory& operator=(const Memory&) = delete;
    int descriptor;
  };
  struct Ends;

  IsolatedProcess(const std::filesystem::path& folder, const Work& work, Ends ends);
  bool has_closed_channel() const;

  Folder folder_;
  Memory memory_;
  Channel channel_;
  pid_t process_ = 0;  ///< 0 after its end
};

}  // namespace hedgehop::sim
