#include "sim/config/streamed_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <stdexcept>
#include <system_error>

namespace hedgehop::sim {

/// Discards the file and names it if the action fails.
template <class Action>
void StreamedFile::guarded(Action action) {
  try {
    action();
  } catch (const std::system_error& error) {
    pending_.reset();
    throw std::runtime_error(fmt::format("cannot write {}: {}", file_.string(), error.code().message()));
  }
}

StreamedFile::StreamedFile(const std::filesystem::path& file) : file_(file) {
  guarded([&] { pending_.emplace(file_); });
}

/// An earlier error has discarded the file.
void StreamedFile::require_open() const {
  if (!pending_) throw std::system_error(EBADF, std::generic_category());
}

void StreamedFile::write(std::string_view bytes) {
  guarded([&] {
    require_open();
    while (!bytes.empty()) {
      const ssize_t written =
          uninterrupted([&] { return ::write(pending_->descriptor(), bytes.data(), bytes.size()); });
      if (written < 0) throw std::system_error(errno, std::generic_category());
      bytes.remove_prefix(static_cast<size_t>(written));
    }
  });
}

void StreamedFile::close() {
  guarded([&] {
    require_open();
    pending_->publish();
  });
}

}  // namespace hedgehop::sim
