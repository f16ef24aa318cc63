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

constexpr uintmax_t kMostBytes = 64'000'000;
constexpr int kDeepest = 200;           // the importer's JSON reader recurses
constexpr int kMostFaceCorners = 1000;  // its triangulation takes their square

/// Depth of brackets outside strings; of a binary glTF, those of its text as well as of bytes that look like them.
int depth(std::string_view json) {
  int now = 0, most = 0;
  bool in_text = false;
  for (size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (in_text && c == '\\') {
      ++i;
    } else if (c == '"') {
      in_text = !in_text;
    } else if (!in_text && (c == '[' || c == '{')) {
      most = std::max(most, ++now);
    } else if (!in_text && (c == ']' || c == '}')) {
      --now;
    }
  }
  return most;
}

/// The text of a binary glTF: its first chunk, after a header of 12 bytes and the chunk's own of 8.
std::string_view json_of_glb(std::string_view file) {
  constexpr size_t kHeader = 20;
  if (file.size() < kHeader) return {};
  uint32_t bytes = 0;
  std::copy_n(file.data() + 12, sizeof bytes, reinterpret_cast<char*>(&bytes));
  return file.substr(kHeader, bytes);
}

/// Words after the `f` of a line; a backslash at a line's end goes on in the next.
int most_face_corners(std::string_view obj) {
  int most = 0, words = 0;
  bool is_face = false, in_word = false;
  for (size_t i = 0; i < obj.size(); ++i) {
    const char c = obj[i];
    if (c == '\n') {
      words = 0;
      is_face = in_word = false;
    } else if (c == '\\') {
      i = std::min(obj.find('\n', i), obj.size());
      in_word = false;
    } else if (c == ' ' || c == '\t' || c == '\r') {
      in_word = false;
    } else if (!in_word) {
      in_word = true;
      if (words == 0) is_face = c == 'f';
      if (is_face) most = std::max(most, words);
      ++words;
    }
  }
  return most;
}

}  // namespace

bool may_be_read(const std::filesystem::path& file) {
  std::error_code error;
  return std::filesystem::is_regular_file(file, error) && std::filesystem::file_size(file, error) <= kMostBytes;
}

void require_importable(const std::filesystem::path& mesh) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(mesh, error)) throw std::invalid_argument("there is no such file");
  if (!may_be_read(mesh)) throw std::invalid_argument("it is larger than 64 MB");
  std::ifstream stream(mesh, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  std::string kind = mesh.extension().string();
  std::ranges::transform(kind, kind.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if ((kind == ".gltf" && depth(text) > kDeepest) || (kind == ".glb" && depth(json_of_glb(text)) > kDeepest)) {
    throw std::invalid_argument("its JSON is nested deeper than " + std::to_string(kDeepest));
  }
  if (kind == ".obj" && most_face_corners(text) > kMostFaceCorners) {
    throw std::invalid_argument("it has a face of more than " + std::to_string(kMostFaceCorners) + " corners");
  }
}

}  // namespace hedgehop::scenes::mesh
