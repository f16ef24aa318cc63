#include "sim/config/pending_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <string>
#include <system_error>
#include <utility>

namespace hedgehop::sim {
namespace {

namespace fs = std::filesystem;

/// Returns whether the file exists and is neither regular nor a folder, such as a pipe or /dev/stdout.
bool is_special(const fs::path& file) {
  struct stat info = {};
  return ::stat(file.c_str(), &info) == 0 && !S_ISREG(info.st_mode) && !S_ISDIR(info.st_mode);
}

int opened(const fs::path& file, int flags) {
  constexpr mode_t kMode = 0666;  // less the umask
  return uninterrupted([&] { return ::open(file.c_str(), flags | O_CLOEXEC, kMode); });
}

[[noreturn]] void fail(int error) { throw std::system_error(error, std::generic_category()); }

}  // namespace

PendingFile::PendingFile(const fs::path& file) : file_(file), part_(file) {
  part_ += ".part";
  if (is_special(file_)) {
    kind_ = Kind::special;
    descriptor_ = opened(file_, O_WRONLY | O_TRUNC);
  } else {
    // path() may be opened for reading and writing only if this descriptor allows both.
    descriptor_ = opened(file_.has_parent_path() ? file_.parent_path() : fs::path("."), O_TMPFILE | O_RDWR);
    bool is_unknown = descriptor_ < 0 && (errno == EOPNOTSUPP || errno == EISDIR || errno == EINVAL);
    if (descriptor_ >= 0 && ::access(path().c_str(), F_OK) != 0) {  // without /proc it could get no name
      ::close(std::exchange(descriptor_, -1));
      is_unknown = true;
    }
    if (is_unknown) {
      kind_ = Kind::named;
      descriptor_ = opened(part_, O_RDWR | O_CREAT | O_TRUNC);
    }
  }
  if (descriptor_ < 0) fail(errno);
}

PendingFile::~PendingFile() { discard(); }

fs::path PendingFile::path() const {
  switch (kind_) {
    case Kind::special:
      return file_;
    case Kind::named:
      return part_;
    case Kind::unnamed:
      break;
  }
  return fmt::format("/proc/self/fd/{}", descriptor_);
}

/// Returns 0 or the error. The file remains open.
int PendingFile::name_unnamed() const {
  const std::string unnamed = path().string();
  const auto link_as = [&](const fs::path& name) {
    return ::linkat(AT_FDCWD, unnamed.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0;
  };
  if (link_as(file_)) return 0;
  if (errno != EEXIST) return errno;
  // Only rename(2) replaces a file without a moment in which it is absent.
  ::unlink(part_.c_str());
  if (link_as(part_) && ::rename(part_.c_str(), file_.c_str()) == 0) return 0;
  const int error = errno;
  ::unlink(part_.c_str());
  return error;
}

/// Returns 0 or the error. On Linux, an interrupted close(2) has closed the file and must not be repeated.
int PendingFile::close() { return ::close(std::exchange(descriptor_, -1)) == 0 || errno == EINTR ? 0 : errno; }

void PendingFile::publish() {
  int error = kind_ == Kind::unnamed ? name_unnamed() : 0;
  const bool is_named = kind_ == Kind::unnamed && error == 0;
  const int closed = close();
  if (error == 0) error = closed;
  if (error == 0 && kind_ == Kind::named && ::rename(part_.c_str(), file_.c_str()) != 0) error = errno;
  if (error == 0) return;
  if (is_named) ::unlink(file_.c_str());
  if (kind_ == Kind::named) ::unlink(part_.c_str());
  fail(error);
}

void PendingFile::discard() {
  if (descriptor_ < 0) return;
  ::close(std::exchange(descriptor_, -1));
  if (kind_ == Kind::named) ::unlink(part_.c_str());
}

}  // namespace hedgehop::sim
