#include "sim/config/folder_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <ranges>
#include <string>
#include <thread>

#include "sim/config/input_error.h"
#include "sim/config/pending_file.h"
#include "sim/config/whole_file.h"

namespace hedgehop::sim {
namespace {

namespace fs = std::filesystem;

// A worker that a killed command was just starting holds the lock until it executes its program.
constexpr std::chrono::milliseconds kWait{10};
constexpr int kMaxWaits = 100;

/// Returns whether the path still names the open file. A holder removes its file before it unlocks it.
bool is_still(const fs::path& file, int descriptor) {
  struct stat open = {}, named = {};
  return ::fstat(descriptor, &open) == 0 && ::stat(file.c_str(), &named) == 0 && open.st_ino == named.st_ino &&
         open.st_dev == named.st_dev;
}

/// Returns the number of the process that the holder wrote; otherwise 0.
pid_t holder_of(int descriptor) {
  char text[32] = {};
  const ssize_t got = ::pread(descriptor, text, sizeof text - 1, 0);
  return got > 0 ? static_cast<pid_t>(std::strtol(text, nullptr, 10)) : 0;
}

/// Returns whether no process has this number.
bool has_ended(pid_t process) { return process > 0 && ::kill(process, 0) != 0 && errno == ESRCH; }

}  // namespace

FolderLock::FolderLock(const fs::path& folder) : folder_(folder) {
  make_folder();
  hold(folder_ / ".hedgehop.lock", true);
}

FolderLock::FolderLock(const fs::path& folder, std::string_view part) : folder_(folder) {
  make_folder();
  hold(folder_ / ".hedgehop.lock", false);
  hold(folder_ / fmt::format(".hedgehop-{}.lock", part), true);
}

FolderLock::~FolderLock() { release(); }

void FolderLock::make_folder() {
  require_writable(folder_);
  std::error_code error;
  std::vector<fs::path> missing;
  for (fs::path at = fs::absolute(folder_).lexically_normal(); !fs::exists(at, error) && at.has_relative_path();
       at = at.parent_path()) {
    if (at.has_filename()) missing.push_back(at);
  }
  for (const fs::path& at : missing | std::views::reverse) {
    if (fs::create_directory(at, error)) made_.push_back(at);
    if (!error) continue;
    release();
    throw std::runtime_error(
        fmt::format("{}: cannot write results: {}: {}", folder_.string(), at.string(), error.message()));
  }
}

void FolderLock::hold(const fs::path& file, bool alone) {
  int waits = kMaxWaits;
  for (;;) {
    const int descriptor = uninterrupted([&] { return ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666); });
    if (descriptor < 0) {
      const int error = errno;
      release();
      throw InputError(
          fmt::format("{}: cannot write results: {}: {}", folder_.string(), file.string(), std::strerror(error)));
    }
    const int operation = (alone ? LOCK_EX : LOCK_SH) | LOCK_NB;
    if (uninterrupted([&] { return ::flock(descriptor, operation); }) != 0 && errno == EWOULDBLOCK) {
      const pid_t holder = holder_of(descriptor);
      ::close(descriptor);
      if (has_ended(holder) && waits-- > 0) {
        std::this_thread::sleep_for(kWait);
        continue;
      }
      release();
      throw InputError(fmt::format("{}: in use by another hedgehop command{}; wait for its end or choose another --out",
                                   folder_.string(), holder > 0 ? fmt::format(" (process {})", holder) : ""));
    }
    if (!is_still(file, descriptor)) {
      ::close(descriptor);
      continue;
    }
    if (alone) {
      const std::string text = fmt::format("{}\n", ::getpid());
      // The number only serves messages.
      if (::ftruncate(descriptor, 0) != 0 || ::pwrite(descriptor, text.data(), text.size(), 0) < 0) errno = 0;
    }
    held_.push_back({file, descriptor, alone});
    return;
  }
}

void FolderLock::release() {
  for (const Held& held : held_ | std::views::reverse) {
    // A shared file is removed by its last holder only.
    if (held.alone || ::flock(held.descriptor, LOCK_EX | LOCK_NB) == 0) ::unlink(held.file.c_str());
    ::close(held.descriptor);
  }
  held_.clear();
  for (const fs::path& folder : made_ | std::views::reverse) ::rmdir(folder.c_str());  // fails unless it is empty
  made_.clear();
}

}  // namespace hedgehop::sim
