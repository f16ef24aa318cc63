#include "sim/config/streamed_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>

namespace hedgehop::sim {
namespace {

/// Returns whether the file exists and is neither regular nor a folder, such as a pipe or /dev/stdout.
bool is_special(const std::filesystem::path& file) {
  struct stat info = {};
  return ::stat(file.c_str(), &info) == 0 && !S_ISREG(info.st_mode) && !S_ISDIR(info.st_mode);
}

}  // namespace

StreamedFile::StreamedFile(const std::filesystem::path& file)
    : file_(file), part_(is_special(file) ? file : std::filesystem::path(file.string() + ".part")) {
  descriptor_ = uninterrupted([&] { return ::open(part_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666); });
  if (descriptor_ < 0) {
    throw std::runtime_error(fmt::format("cannot write {}: {}", file_.string(), std::strerror(errno)));
  }
}

StreamedFile::~StreamedFile() {
  if (descriptor_ < 0) return;
  ::close(descriptor_);
  if (part_ != file_) ::unlink(part_.c_str());
}

void StreamedFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = uninterrupted([&] { return ::write(descriptor_, bytes.data(), bytes.size()); });
    if (written < 0) fail(errno);
    bytes.remove_prefix(static_cast<size_t>(written));
  }
}

void StreamedFile::close() {
  // On Linux, an interrupted close(2) has closed the file and must not be repeated.
  const bool closed = ::close(std::exchange(descriptor_, -1)) == 0 || errno == EINTR;
  const bool named = closed && (part_ == file_ || ::rename(part_.c_str(), file_.c_str()) == 0);
  if (!named) fail(errno);
}

void StreamedFile::fail(int error) {
  if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
  if (part_ != file_) ::unlink(part_.c_str());
  throw std::runtime_error(fmt::format("cannot write {}: {}", file_.string(), std::strerror(error)));
}

}  // namespace hedgehop::sim
