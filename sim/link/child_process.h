#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/link/sockets.h"

namespace hedgehop::sim::link {

/// The process of an autopilot, in a process group of its own. It ends with this object, and with this process.
class ChildProcess {
 public:
  /// @param command  program, searched in PATH, and arguments. @param folder  its working folder, created if necessary.
  /// @param log  file of its standard output and error. Throws InputError if it cannot be started.
  ChildProcess(const std::vector<std::string>& command, const std::filesystem::path& folder,
               const std::filesystem::path& log);
  /// Ends the process group: SIGTERM, and SIGKILL if it does not end within 2 s.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  bool ended() const;
  /// "exit status 1", "SIGSEGV"; only after its end.
  std::string end_words() const;
  int descriptor() const { return process_.number(); }  ///< readable when the process has ended
  const std::filesystem::path& log() const { return log_; }

 private:
  pid_t pid_ = -1;
  Descriptor process_;
  std::filesystem::path log_;
};

/// Returns the command with {instance}, {port} and {seed} replaced.
std::vector<std::string> filled_command(const std::vector<std::string>& command, int64_t instance, int64_t port,
                                        uint64_t seed);

}  // namespace hedgehop::sim::link
