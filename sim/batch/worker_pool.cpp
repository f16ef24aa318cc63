#include "sim/batch/worker_pool.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/signalfd.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "sim/flight/words.h"

namespace hedgehop::sim {
namespace {

constexpr size_t kMaxTailBytes = 4096;

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// Returns the environment of this process, with large pages for the heap: a short flight then has a third of the page
/// faults. A user's setting is kept.
std::vector<char*> worker_environment() {
  static char heap_pages[] = "GLIBC_TUNABLES=glibc.malloc.hugetlb=1";
  std::vector<char*> environment;
  for (char** variable = environ; *variable != nullptr; ++variable) environment.push_back(*variable);
  if (std::getenv("GLIBC_TUNABLES") == nullptr) environment.push_back(heap_pages);
  environment.push_back(nullptr);
  return environment;
}

/// Starts a process; returns 0 or the error.
int spawn(const std::vector<std::string>& command, const sigset_t& mask, int error_end, pid_t& pid) {
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&files, error_end, STDERR_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  // A group of its own: a Ctrl-C reaches the campaign alone, and a kill reaches
  // whatever the worker has started.
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK);
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setsigmask(&attributes, &mask);

  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  std::vector<char*> environment = worker_environment();
  const int error = posix_spawn(&pid, arguments[0], &files, &attributes, arguments.data(), environment.data());
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  return error;
}

bool has_ended(const Worker& worker) {
  pollfd watched{.fd = worker.process_descriptor(), .events = POLLIN, .revents = 0};
  return ::poll(&watched, 1, 0) == 1;
}

}  // namespace

Interruption::Interruption() {
  sigset_t caught;
  sigemptyset(&caught);
  sigaddset(&caught, SIGINT);
  sigaddset(&caught, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &caught, &before_);
  descriptor_ = signalfd(-1, &caught, SFD_NONBLOCK | SFD_CLOEXEC);
  if (descriptor_ < 0) {
    const int error = errno;
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    throw std::runtime_error(fmt::format("cannot watch for signals: {}", std::strerror(error)));
  }
}

Interruption::~Interruption() {
  came();  // or it would end the process now
  ::close(descriptor_);
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

bool Interruption::came() {
  signalfd_siginfo info{};
  while (::read(descriptor_, &info, sizeof info) == sizeof info) {
    if (signal_ == 0) signal_ = static_cast<int>(info.ssi_signo);
  }
  return signal_ != 0;
}

std::string cause_words(const WorkerEnd& end, double limit_s) {
  const std::string message = end.last_line.empty() ? "" : ": " + end.last_line;
  switch (end.kind) {
    case WorkerEnd::Kind::exited:
      return fmt::format("exit status {}{}", end.code, message);
    case WorkerEnd::Kind::signalled:
      return fmt::format("killed by SIG{} ({}){}", sigabbrev_np(end.code) ? sigabbrev_np(end.code) : "?",
                         strsignal(end.code), message);
    case WorkerEnd::Kind::overdue:
      return fmt::format("killed: over its limit of {:g} s of wall time", limit_s);
    case WorkerEnd::Kind::stopped:
      return "stopped: the campaign was interrupted";
    case WorkerEnd::Kind::unstarted:
      return "cannot be started" + message;
  }
  return "";
}

Worker::Worker(const std::vector<std::string>& command, const sigset_t& mask) : started_(Clock::now()) {
  std::array<int, 2> pipe{};
  if (::pipe2(pipe.data(), O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  ::fcntl(pipe[0], F_SETFL, O_NONBLOCK);
  const int error = spawn(command, mask, pipe[1], pid_);
  ::close(pipe[1]);
  error_ = pipe[0];
  if (error != 0) {
    ::close(error_);
    throw std::system_error(error, std::generic_category(), command.at(0));
  }
  process_ = static_cast<int>(::syscall(SYS_pidfd_open, pid_,
                                        0));  // closed on exec; glibc 2.36 declares it for C only
  if (process_ < 0) {
    const int cause = errno;
    kill(WorkerEnd::Kind::stopped);
    join();
    throw std::system_error(cause, std::generic_category(), "pidfd_open");
  }
}

Worker::Worker(Worker&& other) noexcept
    : pid_(std::exchange(other.pid_, -1)),
      process_(std::exchange(other.process_, -1)),
      error_(std::exchange(other.error_, -1)),
      started_(other.started_),
      killed_(other.killed_),
      tail_(std::move(other.tail_)) {}

Worker::~Worker() {
  if (pid_ < 0) return;
  kill(WorkerEnd::Kind::stopped);
  join();
}

void Worker::take_errors() {
  std::array<char, 4096> buffer{};
  while (error_ >= 0) {
    const ssize_t got = ::read(error_, buffer.data(), buffer.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0 && errno == EAGAIN) return;
    if (got <= 0) {
      ::close(std::exchange(error_, -1));
      return;
    }
    tail_.append(buffer.data(), static_cast<size_t>(got));
    if (tail_.size() > kMaxTailBytes) tail_.erase(0, tail_.size() - kMaxTailBytes);
  }
}

void Worker::kill(WorkerEnd::Kind why) {
  if (pid_ < 0) return;
  if (!killed_) killed_ = why;
  ::kill(-pid_, SIGKILL);
}

WorkerEnd Worker::join() {
  siginfo_t info{};
  while (::waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOWAIT) < 0 && errno == EINTR) {
  }
  ::kill(-pid_, SIGKILL);  // processes that it may have left running; its process
                           // id is not reused before the next call
  int status = 0;
  rusage usage{};
  while (::wait4(pid_, &status, 0, &usage) < 0 && errno == EINTR) {
  }
  WorkerEnd end{.code = WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status)};
  end.wall_s = std::chrono::duration<double>(Clock::now() - started_).count();
  end.cpu_s = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  end.kind = WIFSIGNALED(status) ? killed_.value_or(WorkerEnd::Kind::signalled) : WorkerEnd::Kind::exited;
  take_errors();
  if (error_ >= 0) ::close(std::exchange(error_, -1));
  if (process_ >= 0) ::close(std::exchange(process_, -1));
  pid_ = -1;
  end.last_line = last_line(tail_);
  return end;
}

void WorkerPool::start(size_t job, const std::vector<std::string>& command) {
  try {
    running_.push_back({job, Worker(command, interruption_.mask_before())});
  } catch (const std::system_error& error) {
    ended_.push_back({job, {.kind = WorkerEnd::Kind::unstarted, .last_line = error.what()}});
  }
}

double WorkerPool::left_s(const Worker& worker) const {
  return limit_s_ - std::chrono::duration<double>(Worker::Clock::now() - worker.started()).count();
}

/// Waits until a worker ends or writes to standard error, its time is over, or
/// a signal comes.
void WorkerPool::wait() const {
  std::vector<pollfd> watched{{.fd = interruption_.descriptor(), .events = POLLIN, .revents = 0}};
  double timeout_s = -1.0;
  for (const Running& r : running_) {
    watched.push_back({.fd = r.worker.process_descriptor(), .events = POLLIN, .revents = 0});
    watched.push_back({.fd = r.worker.error_descriptor(), .events = POLLIN, .revents = 0});  // poll skips a -1
    if (limit_s_ <= 0.0 || r.worker.killed()) continue;
    const double left = std::max(0.0, left_s(r.worker));
    timeout_s = timeout_s < 0.0 ? left : std::min(timeout_s, left);
  }
  constexpr double kMaxTimeoutS = 1e6;  // within poll's int in ms
  const int timeout_ms = timeout_s < 0.0 ? -1 : static_cast<int>(std::ceil(1e3 * std::min(timeout_s, kMaxTimeoutS)));
  ::poll(watched.data(), watched.size(), timeout_ms);
}

std::optional<JobEnd> WorkerPool::next() {
  while (ended_.empty() && !running_.empty()) {
    const bool stop = interruption_.came();
    if (stop) {
      for (Running& r : running_) r.worker.kill(WorkerEnd::Kind::stopped);
    } else {
      wait();
    }
    for (auto r = running_.begin(); r != running_.end();) {
      r->worker.take_errors();
      if (limit_s_ > 0.0 && left_s(r->worker) <= 0.0) r->worker.kill(WorkerEnd::Kind::overdue);
      if (!stop && !has_ended(r->worker)) {
        ++r;
        continue;
      }
      ended_.push_back({r->job, r->worker.join()});
      r = running_.erase(r);
    }
  }
  if (ended_.empty()) return {};
  JobEnd end = std::move(ended_.front());
  ended_.pop_front();
  return end;
}

}  // namespace hedgehop::sim
