#include "sim/cli/commands.h"

#include <fmt/format.h>

#include <algorithm>

#include "sim/config/include.h"
#include "sim/config/input_error.h"

namespace hedgehop::sim::cli {

std::vector<std::filesystem::path> shipped_files(const std::string& folder) {
  namespace fs = std::filesystem;
  std::error_code error;
  fs::path place = fs::path("configs") / folder;
  if (const fs::path installed = installed_configs(); !fs::is_directory(place, error) && !installed.empty()) {
    place = installed / folder;
  }
  if (!fs::is_directory(place, error)) {
    throw InputError(fmt::format(
        "{}: there is no such folder; run this command in the source checkout, or install Hedgehop", place.string()));
  }
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(place, error)) {
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  }
  if (files.empty()) throw InputError(fmt::format("{}: no files (*.yaml) in this folder", place.string()));
  std::ranges::sort(files);
  return files;
}

}  // namespace hedgehop::sim::cli
