#include "sim/batch/folders.h"

#include <fmt/format.h>

#include <system_error>

#include "sim/config/input_error.h"

namespace hedgehop::sim {

void create_folders(const std::filesystem::path& folder) {
  if (folder.empty()) return;
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw InputError(fmt::format("{}: cannot create this folder: {}", folder.string(), error.message()));
}

bool has_file(const std::filesystem::path& folder, std::string_view name) {
  std::error_code error;
  const bool is_there = std::filesystem::exists(folder / name, error);  // no error if it is missing
  if (error) throw InputError(fmt::format("{}: cannot read this folder: {}", folder.string(), error.message()));
  return is_there;
}

}  // namespace hedgehop::sim
