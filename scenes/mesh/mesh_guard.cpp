#include "scenes/mesh/mesh_guard.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>

namespace hedgehop::scenes::mesh {
namespace {

constexpr uintmax_t kMaxBytes = 64'000'000;
constexpr int kMaxNesting = 200;  // the importer's JSON reader recurses
constexpr size_t kMaxNodes = 2'000;
constexpr size_t kMaxFaces = 500'000;

/// What the importer recurses over in a glTF.
struct JsonNesting {
  int brackets = 0;  ///< nested, outside strings
  size_t nodes = 0;  ///< each may hold the next
};

JsonNesting json_nesting(std::string_view json) {
  JsonNesting found;
  int now = 0;
  size_t text = 0;
  bool in_text = false, in_nodes = false;
  std::string_view key;
  for (size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (in_text && c == '\\') {
      ++i;
    } else if (c == '"') {
      in_text = !in_text;
      if (in_text) text = i + 1;
      if (!in_text && now == 1) key = json.substr(text, i - text);
    } else if (!in_text && (c == '[' || c == '{')) {
      found.brackets = std::max(found.brackets, ++now);
      if (now == 2) in_nodes = key == "nodes" || key.find('\\') != std::string_view::npos;
      if (now == 3 && in_nodes) ++found.nodes;
    } else if (!in_text && (c == ']' || c == '}')) {
      --now;
    }
  }
  return found;
}

/// The text of a binary glTF: its first chunk, after a header of 12 bytes and the chunk's own of 8.
std::string_view json_of_glb(std::string_view file) {
  constexpr size_t kHeader = 20;
  if (file.size() < kHeader) return {};
  uint32_t bytes = 0;
  std::copy_n(file.data() + 12, sizeof bytes, reinterpret_cast<char*>(&bytes));
  return file.substr(kHeader, bytes);
}

/// Lines that begin with an `f`; each costs the importer far more than its bytes.
size_t faces(std::string_view obj) {
  size_t count = 0;
  bool at_start = true;
  for (const char c : obj) {
    if (at_start && c == 'f') ++count;
    at_start = c == '\n' || (at_start && (c == ' ' || c == '\t'));
  }
  return count;
}

}  // namespace

bool may_be_read(const std::filesystem::path& file) {
  std::error_code error;
  return std::filesystem::is_regular_file(file, error) && std::filesystem::file_size(file, error) <= kMaxBytes;
}

void require_importable(const std::filesystem::path& mesh) {
  std::error_code error;
  if (!std::filesystem::exists(mesh, error)) throw std::invalid_argument("there is no such file");
  if (!std::filesystem::is_regular_file(mesh, error)) throw std::invalid_argument("it is no regular file");
  if (!may_be_read(mesh)) throw std::invalid_argument("it is larger than 64 MB");
  std::string kind = mesh.extension().string();
  std::ranges::transform(kind, kind.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (kind != ".obj" && kind != ".gltf" && kind != ".glb") {
    throw std::invalid_argument("its name ends in none of .obj, .gltf and .glb");
  }
  std::ifstream stream(mesh, std::ios::binary);
  std::string text(std::filesystem::file_size(mesh, error), '\0');
  stream.read(text.data(), std::ssize(text));
  text.resize(static_cast<size_t>(stream.gcount()));
  if (!stream.is_open() || stream.bad()) throw std::invalid_argument("it cannot be read");
  if (kind != ".obj") {
    const JsonNesting found = json_nesting(kind == ".glb" ? json_of_glb(text) : text);
    if (found.brackets > kMaxNesting) {
      throw std::invalid_argument("its JSON is nested deeper than " + std::to_string(kMaxNesting));
    }
    if (found.nodes > kMaxNodes)
      throw std::invalid_argument("it has more than " + std::to_string(kMaxNodes) + " nodes");
  }
  if (kind == ".obj" && faces(text) > kMaxFaces) {
    throw std::invalid_argument("it has more than " + std::to_string(kMaxFaces) + " faces");
  }
}

}  // namespace hedgehop::scenes::mesh
