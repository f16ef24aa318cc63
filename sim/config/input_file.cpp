#include "sim/config/input_file.h"

#include <fstream>
#include <ios>
#include <stdexcept>

namespace hedgehop::sim {

std::filesystem::path installed_configs() {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::filesystem::path configs = program.parent_path().parent_path() / "share" / "hedgehop" / "configs";
  return std::filesystem::is_directory(configs, error) ? configs : std::filesystem::path();
}

std::string read_input_file(const std::filesystem::path& file) {
  constexpr uintmax_t kMostBytes = 64'000'000;
  std::error_code error;
  if (!std::filesystem::exists(file, error)) throw std::invalid_argument("there is no such file");
  if (std::filesystem::is_directory(file, error)) throw std::invalid_argument("is a folder, not a file");
  if (!std::filesystem::is_regular_file(file, error)) throw std::invalid_argument("is a device or a pipe, not a file");
  const uintmax_t bytes = std::filesystem::file_size(file, error);
  if (error || bytes > kMostBytes) throw std::invalid_argument("is larger than 64 MB");
  std::ifstream stream(file, std::ios::binary);
  std::string text(bytes, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(bytes));
  text.resize(static_cast<size_t>(stream.gcount()));
  if (!stream.is_open() || stream.bad()) throw std::invalid_argument("the file cannot be read");
  return text;
}

}  // namespace hedgehop::sim
