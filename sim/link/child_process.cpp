#include "sim/link/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <system_error>

#include "sim/config/input_error.h"

namespace hedgehop::sim::link {
namespace {

constexpr int kEndWithinMs = 2000;

/// Runs in the new process; only functions that are safe there. Returns after a failure, with errno set.
void become(const std::vector<char*>& arguments, const char* folder, int log, pid_t parent) {
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(127);
  const int input = ::open("/dev/null", O_RDONLY);
  if (input < 0 || ::dup2(input, STDIN_FILENO) < 0 || ::dup2(log, STDOUT_FILENO) < 0 ||
      ::dup2(log, STDERR_FILENO) < 0 || ::chdir(folder) != 0) {
    return;
  }
  ::execvp(arguments[0], arguments.data());
}

bool waits_until_readable(int descriptor, int timeout_ms) {
  pollfd watched{.fd = descriptor, .events = POLLIN, .revents = 0};
  return ::poll(&watched, 1, timeout_ms) == 1;
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& command, const std::filesystem::path& folder,
                           const std::filesystem::path& log)
    : log_(log) {
  std::filesystem::create_directories(folder);
  const Descriptor output(::open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644));
  std::array<int, 2> ends{};
  if (output.number() < 0 || ::pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw std::system_error(errno, std::generic_category(), log.string());
  }
  const Descriptor read_end(ends[0]);
  Descriptor write_end(ends[1]);
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const pid_t parent = ::getpid();
  pid_ = ::fork();
  if (pid_ == 0) {
    become(arguments, folder.c_str(), output.number(), parent);
    const int error = errno;
    [[maybe_unused]] const ssize_t written = ::write(write_end.number(), &error, sizeof error);
    ::_exit(127);
  }
  write_end = Descriptor();
  int error = errno;
  if (pid_ > 0 && ::read(read_end.number(), &error, sizeof error) != sizeof error) error = 0;
  if (error != 0 || pid_ < 0) {
    if (pid_ > 0) ::waitpid(pid_, nullptr, 0);
    throw InputError(fmt::format("link.command: '{}' cannot be started: {}", command.at(0), std::strerror(error)));
  }
  process_ = Descriptor(static_cast<int>(::syscall(SYS_pidfd_open, pid_, 0)));
}

ChildProcess::~ChildProcess() {
  ::kill(-pid_, SIGTERM);
  if (process_.number() < 0 || !waits_until_readable(process_.number(), kEndWithinMs)) ::kill(-pid_, SIGKILL);
  siginfo_t info{};
  while (::waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOWAIT) < 0 && errno == EINTR) {
  }
  ::kill(-pid_, SIGKILL);  // processes that it left; its number is not used again before the next call
  ::waitpid(pid_, nullptr, 0);
}

bool ChildProcess::ended() const { return process_.number() >= 0 && waits_until_readable(process_.number(), 0); }

std::string ChildProcess::end_words() const {
  siginfo_t info{};
  ::waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOWAIT | WNOHANG);
  if (info.si_code == CLD_EXITED) return fmt::format("exit status {}", info.si_status);
  const char* const name = ::sigabbrev_np(info.si_status);
  return fmt::format("SIG{}", name ? name : "?");
}

std::vector<std::string> filled_command(const std::vector<std::string>& command, int64_t instance, int64_t port,
                                        uint64_t seed) {
  const std::array<std::pair<std::string, std::string>, 3> values = {
      {{"{instance}", std::to_string(instance)}, {"{port}", std::to_string(port)}, {"{seed}", std::to_string(seed)}}};
  std::vector<std::string> filled = command;
  for (std::string& word : filled) {
    for (const auto& [name, value] : values) {
      for (size_t at = word.find(name); at != std::string::npos; at = word.find(name, at + value.size())) {
        word.replace(at, name.size(), value);
      }
    }
  }
  return filled;
}

}  // namespace hedgehop::sim::link
