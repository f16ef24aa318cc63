#include "sim/config/whole_file.h"

#include "sim/config/input_error.h"
#include "sim/config/streamed_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>

namespace hedgehop::sim {
namespace {

/// Throws InputError if the user can correct the fault, std::runtime_error if it is the machine's.
[[noreturn]] void refuse(const std::filesystem::path& file, int error) {
  const bool is_missing = error == ENOENT || error == ENOTDIR;
  const std::string text = fmt::format(
      "{}: {}", file.string(), is_missing ? "there is no such file" : unreadable({error, std::generic_category()}));
  if (is_missing || error == EACCES || error == EPERM || error == ELOOP || error == ENAMETOOLONG)
    throw InputError(text);
  throw std::runtime_error(text);
}

[[noreturn]] void refuse_folder(const std::filesystem::path& folder, const std::filesystem::path& there,
                                const std::string& why) {
  throw InputError(fmt::format("{}: cannot write results: {}: {}", folder.string(), there.string(), why));
}

}  // namespace

std::string unreadable(const std::error_code& error) { return fmt::format("cannot be read: {}", error.message()); }

void write_file_whole(const std::filesystem::path& file, std::string_view text) {
  StreamedFile out(file);
  out.write(text);
  out.close();
}

std::string read_file_whole(const std::filesystem::path& file) {
  const int descriptor = uninterrupted([&] { return ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK); });
  if (descriptor < 0) refuse(file, errno);
  struct stat info = {};
  std::string text;
  int error = ::fstat(descriptor, &info) == 0 ? 0 : errno;
  if (error == 0 && !S_ISREG(info.st_mode)) {
    ::close(descriptor);
    throw InputError(
        fmt::format("{}: is a {}, not a file", file.string(), S_ISDIR(info.st_mode) ? "folder" : "device or a pipe"));
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
  if (error != 0) refuse(file, error);
  return text;
}

std::string read_input_file(const std::filesystem::path& file) {
  namespace fs = std::filesystem;
  constexpr uintmax_t kMaxBytes = 64'000'000;
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found) throw std::invalid_argument("there is no such file");
  if (error) throw std::invalid_argument(unreadable(error));
  if (fs::is_directory(status)) throw std::invalid_argument("is a folder, not a file");
  if (!fs::is_regular_file(status)) throw std::invalid_argument("is a device or a pipe, not a file");
  const uintmax_t bytes = fs::file_size(file, error);
  if (error) throw std::invalid_argument(unreadable(error));
  if (bytes > kMaxBytes) throw std::invalid_argument("is larger than 64 MB");
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  std::string text(bytes, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(bytes));
  text.resize(static_cast<size_t>(stream.gcount()));
  if (!stream.is_open() || stream.bad()) throw std::invalid_argument(unreadable({errno, std::generic_category()}));
  return text;
}

void require_writable(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::path there = std::filesystem::absolute(folder);
  bool is_missing = false;
  for (; !std::filesystem::exists(there, error) && !error && there.has_relative_path(); there = there.parent_path()) {
    std::error_code ignored;
    if (std::filesystem::is_symlink(there, ignored)) refuse_folder(folder, there, "is a link to a missing folder");
    is_missing = true;
  }
  if (!error && !std::filesystem::is_directory(there, error)) error = std::make_error_code(std::errc::not_a_directory);
  // Creates a folder to check permissions, with another name, because other processes may create the requested one.
  std::string probe = (there / ".hedgehop-XXXXXX").string();
  if (!error && !is_missing && ::access(there.c_str(), W_OK) != 0) error = {errno, std::generic_category()};
  if (!error && is_missing && !::mkdtemp(probe.data())) error = {errno, std::generic_category()};
  if (!error && is_missing) ::rmdir(probe.c_str());
  if (error) refuse_folder(folder, there, error.message());
}

void require_writable_file(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) {
    throw InputError(fmt::format("{}: cannot be written: is a folder", file.string()));
  }
  require_writable(file.has_parent_path() ? file.parent_path() : ".");
}

}  // namespace hedgehop::sim
