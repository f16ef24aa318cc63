// Simulates a failing disk as a library between a program and the C library (LD_PRELOAD). It counts the file calls of
// the program and its children below one folder: create, write, link, rename, mkdir, and close of a written file. It
// then lets one call, or all calls from one on, fail:
//   FAILING_DISK_FOLDER   absolute path of the folder
//   FAILING_DISK_COUNTER  file of 16 bytes, initially zero, which is the shared counter of these processes
//   FAILING_DISK_FAULT    none
//                         full, broken: ENOSPC or EIO from the call on
//                         hiccup: EIO for this call only
//                         kill, kill_first: before the call, SIGKILL to its process or to the first of all processes
//                         interrupted: EINTR for half of all calls, including reads and polls; writes end early
//   FAILING_DISK_AT       number of the call, from 1
#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string_view>

namespace {

std::string_view setting(const char* name) {
  const char* const value = std::getenv(name);
  return value ? value : "";
}

struct Settings {
  std::string_view folder = setting("FAILING_DISK_FOLDER"), fault = setting("FAILING_DISK_FAULT");
  uint64_t at = std::strtoull(setting("FAILING_DISK_AT").data(), nullptr, 10);
};
const Settings& settings() {
  static const Settings the;
  return the;
}

template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

/// The state shared by all processes.
struct Shared {
  std::atomic<uint64_t> calls;
  std::atomic<int64_t> first;  ///< process
};

Shared& shared() {
  static Shared* const the = [] {
    static const auto open_file = real<int(const char*, int, ...)>("open");
    const int file = open_file(setting("FAILING_DISK_COUNTER").data(), O_RDWR | O_CLOEXEC);
    void* const page = mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    if (file < 0 || page == MAP_FAILED) std::abort();
    static const auto close_file = real<int(int)>("close");
    close_file(file);
    return static_cast<Shared*>(page);
  }();
  return *the;
}

[[gnu::constructor]] void enter() {
  int64_t nobody = 0;
  shared().first.compare_exchange_strong(nobody, getpid());
}

bool is_below(std::string_view path) {
  return !settings().folder.empty() && path.starts_with(settings().folder) &&
         (path.size() == settings().folder.size() || path[settings().folder.size()] == '/');
}

bool is_below(const char* path) {
  if (path[0] == '/') return is_below(std::string_view(path));
  char whole[8192];
  if (!getcwd(whole, 4096)) return false;
  std::string_view folder(whole);
  return static_cast<size_t>(std::snprintf(whole + folder.size(), 4096, "/%s", path)) < 4096 &&
         is_below(std::string_view(whole));
}

bool is_below(int descriptor) {
  char link[64], path[4096];
  std::snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
  const ssize_t length = readlink(link, path, sizeof path);
  return length > 0 && is_below(std::string_view(path, static_cast<size_t>(length)));
}

bool interrupts() { return settings().fault == "interrupted"; }

/// Returns whether this call is interrupted: half of the calls of this process, in an irregular order.
bool is_interrupted() {
  static std::atomic<uint64_t> calls;
  return std::mt19937_64(calls++)() % 2 == 0;
}

/// Returns the error of this call to a file below the folder; otherwise 0.
int fault_now() {
  const int before = errno;
  const uint64_t call = shared().calls.fetch_add(1) + 1;
  const Settings& s = settings();
  if (interrupts()) return is_interrupted() ? EINTR : 0;
  if (call < s.at || s.at == 0) return 0;
  if (s.fault == "full") return ENOSPC;
  if (s.fault == "broken") return EIO;
  if (call != s.at) return 0;
  if (s.fault == "hiccup") return EIO;
  if (s.fault == "kill") kill(getpid(), SIGKILL);
  if (s.fault == "kill_first") kill(static_cast<pid_t>(shared().first), SIGKILL);
  errno = before;
  return 0;
}

template <class Result, class Call>
Result unless_faulty(bool counts, Call call) {
  if (const int error = counts ? fault_now() : 0; error != 0) {
    errno = error;
    return static_cast<Result>(-1);
  }
  return call();
}

/// Returns the number of bytes that an interrupted write writes.
size_t cut(size_t count) { return interrupts() ? (count + 1) / 2 : count; }

mode_t mode_of(int flags, va_list rest) { return (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(rest, mode_t) : 0; }

bool writes(int flags) { return (flags & O_ACCMODE) != O_RDONLY; }

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
  static const auto next = real<int(const char*, int, ...)>("open");
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = mode_of(flags, rest);
  va_end(rest);
  return unless_faulty<int>(writes(flags) && is_below(path), [&] { return next(path, flags, mode); });
}
int open64(const char* path, int flags, ...) {
  static const auto next = real<int(const char*, int, ...)>("open64");
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = mode_of(flags, rest);
  va_end(rest);
  return unless_faulty<int>(writes(flags) && is_below(path), [&] { return next(path, flags, mode); });
}

ssize_t write(int file, const void* bytes, size_t count) {
  static const auto next = real<ssize_t(int, const void*, size_t)>("write");
  const bool below = is_below(file);
  return unless_faulty<ssize_t>(below, [&] { return next(file, bytes, below ? cut(count) : count); });
}
ssize_t pwrite64(int file, const void* bytes, size_t count, off64_t at) {
  static const auto next = real<ssize_t(int, const void*, size_t, off64_t)>("pwrite64");
  const bool below = is_below(file);
  return unless_faulty<ssize_t>(below, [&] { return next(file, bytes, below ? cut(count) : count, at); });
}

ssize_t read(int file, void* bytes, size_t count) {
  static const auto next = real<ssize_t(int, void*, size_t)>("read");
  return unless_faulty<ssize_t>(interrupts() && is_below(file), [&] { return next(file, bytes, count); });
}

int poll(pollfd* watched, nfds_t count, int timeout_ms) {
  static const auto next = real<int(pollfd*, nfds_t, int)>("poll");
  if (interrupts() && is_interrupted()) {
    errno = EINTR;
    return -1;
  }
  return next(watched, count, timeout_ms);
}

int rename(const char* from, const char* to) noexcept {
  static const auto next = real<int(const char*, const char*)>("rename");
  return unless_faulty<int>(!interrupts() && is_below(to), [&] { return next(from, to); });
}

int linkat(int from_folder, const char* from, int to_folder, const char* to, int flags) noexcept {
  static const auto next = real<int(int, const char*, int, const char*, int)>("linkat");
  return unless_faulty<int>(!interrupts() && is_below(to),
                            [&] { return next(from_folder, from, to_folder, to, flags); });
}

int mkdir(const char* path, mode_t mode) noexcept {
  static const auto next = real<int(const char*, mode_t)>("mkdir");
  return unless_faulty<int>(!interrupts() && is_below(path), [&] { return next(path, mode); });
}

/// As on a network disk, a write error may be reported only by close(). The file is closed nevertheless.
int close(int file) {
  static const auto next = real<int(int)>("close");
  const int flags = fcntl(file, F_GETFL);
  const int error = flags >= 0 && writes(flags) && is_below(file) ? fault_now() : 0;
  const int result = next(file);
  if (error == 0) return result;
  errno = error;
  return -1;
}

}  // extern "C"
