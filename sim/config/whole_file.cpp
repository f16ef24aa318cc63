#include "sim/config/whole_file.h"

#include "sim/config/input_error.h"
#include "sim/config/streamed_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>
#include <system_error>

namespace hedgehop::sim {
namespace {

[[noreturn]] void fail_reading(const std::filesystem::path& file, int error) {
  throw std::runtime_error(fmt::format("cannot read {}: {}", file.string(), std::strerror(error)));
}

[[noreturn]] void refuse(const std::filesystem::path& file, std::string_view why) {
  throw InputError(fmt::format("cannot read {}: {}", file.string(), why));
}

}  // namespace

void write_file_whole(const std::filesystem::path& file, std::string_view text) {
  StreamedFile out(file);
  out.write(text);
  out.close();
}

std::string read_file_whole(const std::filesystem::path& file) {
  const int descriptor = uninterrupted([&] { return ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK); });
  if (descriptor < 0 && (errno == ENOENT || errno == ENOTDIR)) refuse(file, std::strerror(errno));
  if (descriptor < 0) fail_reading(file, errno);
  struct stat info = {};
  std::string text;
  int error = ::fstat(descriptor, &info) == 0 ? 0 : errno;
  if (error == 0 && !S_ISREG(info.st_mode)) {
    ::close(descriptor);
    refuse(file, S_ISDIR(info.st_mode) ? std::strerror(EISDIR) : "is a device or a pipe, not a file");
  }
  if (error == 0) text.resize(static_cast<size_t>(info.st_size));
  size_t filled = 0;
  while (error == 0 && filled < text.size()) {
    const ssize_t got = uninterrupted([&] { return ::read(descriptor, text.data() + filled, text.size() - filled); });
    if (got > 0) filled += static_cast<size_t>(got);
    if (got == 0) text.resize(filled);
    if (got < 0) error = errno;
  }
  ::close(descriptor);
  if (error != 0) fail_reading(file, error);
  return text;
}

void require_writable(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::path there = std::filesystem::absolute(folder);
  bool is_missing = false;
  for (; !std::filesystem::exists(there, error) && !error && there.has_relative_path(); there = there.parent_path()) {
    std::error_code ignored;
    if (std::filesystem::is_symlink(there, ignored)) break;  // to a missing folder: none can be created here
    is_missing = true;
  }
  if (!error && !std::filesystem::is_directory(there, error)) error = std::make_error_code(std::errc::not_a_directory);
  // Creates a folder to check permissions, with another name, because other processes may create the requested one.
  std::string probe = (there / ".hedgehop-XXXXXX").string();
  if (!error && !is_missing && ::access(there.c_str(), W_OK) != 0) error = {errno, std::generic_category()};
  if (!error && is_missing && !::mkdtemp(probe.data())) error = {errno, std::generic_category()};
  if (!error && is_missing) ::rmdir(probe.c_str());
  if (error) {
    throw InputError(fmt::format("{}: cannot write results: {}: {}", folder.string(), there.string(), error.message()));
  }
}

void require_writable_file(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) {
    throw InputError(fmt::format("{}: cannot be written: is a folder", file.string()));
  }
  require_writable(file.has_parent_path() ? file.parent_path() : ".");
}

}  // namespace hedgehop::sim
