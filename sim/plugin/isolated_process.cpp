#include "sim/plugin/isolated_process.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <string>
#include <system_error>

namespace hedgehop::sim {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLogName = "module.log";

[[noreturn]] void fail_process(const char* what) { throw std::system_error(errno, std::generic_category(), what); }

/// Prepares the copy after fork(): it keeps two descriptors, and its output goes to its log.
void isolate(const fs::path& folder, pid_t parent, bool from_main_thread, int socket, int memory) {
  ::setsid();  // a group of its own, to be killed with all its children
  if (from_main_thread) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(1);
  }
  for (int signal = 1; signal < NSIG; ++signal) ::signal(signal, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  const int input = ::open("/dev/null", O_RDONLY),
            log = ::open((folder / kLogName).c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND, 0666);
  ::dup2(input, STDIN_FILENO);
  ::dup2(log, STDOUT_FILENO);
  ::dup2(log, STDERR_FILENO);
  const int kept[] = {std::min(socket, memory), std::max(socket, memory)};
  if (kept[0] > 3) ::close_range(3, static_cast<unsigned>(kept[0] - 1), 0);
  if (kept[1] > kept[0] + 1) ::close_range(static_cast<unsigned>(kept[0] + 1), static_cast<unsigned>(kept[1] - 1), 0);
  ::close_range(static_cast<unsigned>(kept[1] + 1), ~0U, 0);
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  if (::chdir(folder.c_str()) != 0) ::_exit(1);
  // Runs before the handlers of the simulator, such as those of its renderer, which would wait for its threads.
  ::on_exit([](int status, void*) { ::_exit(status); }, nullptr);
}

}  // namespace

IsolatedProcess::Folder::Folder(const fs::path& folder) : folder_(folder), is_temporary_(folder.empty()) {
  if (is_temporary_) {
    std::string name = (fs::temp_directory_path() / "hedgehop-module-XXXXXX").string();
    if (!::mkdtemp(name.data())) fail_process("folder of a module");
    folder_ = name;
  }
  fs::create_directories(folder_);
  folder_ = fs::absolute(folder_);
}

IsolatedProcess::Folder::~Folder() {
  std::error_code ignored;
  const fs::path log = folder_ / kLogName;
  if (fs::file_size(log, ignored) == 0) fs::remove(log, ignored);
  is_temporary_ ? fs::remove_all(folder_, ignored) : static_cast<uintmax_t>(fs::remove(folder_, ignored));
}

IsolatedProcess::Memory::Memory() : descriptor(::memfd_create("hedgehop-images", MFD_CLOEXEC)) {
  if (descriptor < 0) fail_process("shared memory of a module");
}
IsolatedProcess::Memory::~Memory() { ::close(descriptor); }

/// The two ends of the channel.
struct IsolatedProcess::Ends {
  Ends() {
    int both[2];
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, both) != 0) fail_process("socket of a module");
    own = both[0];
    other = both[1];
  }
  int own, other;
};

IsolatedProcess::IsolatedProcess(const fs::path& folder, const Work& work) : IsolatedProcess(folder, work, Ends()) {}

IsolatedProcess::IsolatedProcess(const fs::path& folder, const Work& work, Ends ends)
    : folder_(folder), channel_(ends.own) {
  Channel other(ends.other);
  const pid_t parent = ::getpid();
  const bool from_main_thread = parent == ::gettid();
  process_ = ::fork();
  if (process_ < 0) fail_process("process of a module");
  if (process_ > 0) return;
  isolate(folder_.path(), parent, from_main_thread, ends.other, memory());
  work(other, memory());
  ::_exit(0);
}

IsolatedProcess::~IsolatedProcess() { stop(); }

int IsolatedProcess::stop() {
  if (process_ <= 0) return 0;
  constexpr int kMoments = 50;
  constexpr useconds_t kMomentUs = 2000;
  int status = 0;
  bool has_ended = false;
  for (int moment = 0; moment < kMoments && !has_ended; ++moment) {
    has_ended = ::waitpid(process_, &status, WNOHANG) == process_;
    if (moment == 0 && !has_closed_channel()) break;
    if (!has_ended) ::usleep(kMomentUs);
  }
  ::kill(-process_, SIGKILL);  // its children, too
  if (!has_ended) {
    ::kill(process_, SIGKILL);
    while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
  }
  process_ = 0;
  channel_.close();
  return status;
}

bool IsolatedProcess::has_closed_channel() const {
  char byte = 0;
  return ::recv(channel_.descriptor(), &byte, 1, MSG_PEEK | MSG_DONTWAIT) == 0;
}

}  // namespace hedgehop::sim
