#include "scenes/mesh/gltf_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "scenes/mesh/mesh_reader.h"
#include "scenes/mesh/model.h"
#include "scenes/mesh/uri.h"

namespace hedgehop::scenes::mesh {

namespace {

constexpr size_t kMaxNumbers = 30'000'000;  // of an accessor; also of one without data

std::vector<uint8_t> bytes_in(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) fail_gltf("it cannot be read");
  std::error_code error;
  std::vector<uint8_t> bytes(std::filesystem::file_size(file, error));
  if (error) fail_gltf("it cannot be read");
  stream.read(reinterpret_cast<char*>(bytes.data()), std::ssize(bytes));
  bytes.resize(static_cast<size_t>(stream.gcount()));
  return bytes;
}

uint32_t word_at(std::span<const uint8_t> bytes, size_t offset) {
  uint32_t word = 0;
  if (offset + sizeof word > bytes.size()) fail_gltf("it ends too early");
  std::memcpy(&word, bytes.data() + offset, sizeof word);
  return word;
}

// The chunks of a binary glTF.
struct Chunks {
  std::span<const uint8_t> json, binary;
};

Chunks chunks_of(std::span<const uint8_t> file) {
  constexpr size_t kHeader = 12, kChunkHeader = 8;
  constexpr uint32_t kVersion = 2, kJson = 0x4e4f534a, kBinary = 0x004e4942;
  if (file.size() < kHeader || std::memcmp(file.data(), "glTF", 4) != 0) fail_gltf("it is not a binary glTF");
  if (word_at(file, 4) != kVersion) fail_gltf("it is a binary glTF of another version than 2");
  Chunks found;
  for (size_t at = kHeader; at + kChunkHeader <= file.size();) {
    const size_t bytes = word_at(file, at);
    const uint32_t kind = word_at(file, at + 4);
    if (bytes > file.size() - at - kChunkHeader) fail_gltf("it ends too early");
    const auto chunk = file.subspan(at + kChunkHeader, bytes);
    if (kind == kJson && found.json.empty()) found.json = chunk;
    if (kind == kBinary && found.binary.empty()) found.binary = chunk;
    at += kChunkHeader + bytes;
  }
  return found;
}

size_t components_of(const std::string& type) {
  constexpr std::array<std::pair<std::string_view, size_t>, 4> kTypes{
      {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}}};
  for (const auto& [name, components] : kTypes) {
    if (type == name) return components;
  }
  fail_gltf("an accessor has the type '" + type + "'; valid: SCALAR, VEC2, VEC3, VEC4");
}

// Calls `read` with a value of the component type.
template <class Read>
auto with_component(size_t type, const Read& read) {
  switch (type) {
    case 5120:
      return read(int8_t{});
    case 5121:
      return read(uint8_t{});
    case 5122:
      return read(int16_t{});
    case 5123:
      return read(uint16_t{});
    case 5125:
      return read(uint32_t{});
    case 5126:
      return read(float{});
    default:
      fail_gltf("an accessor has the componentType " + std::to_string(type) + "; valid: 5120 to 5123, 5125, 5126");
  }
}

template <class Component>
float normalized(Component value) {
  if constexpr (std::is_floating_point_v<Component>) return value;
  const double limit = std::numeric_limits<Component>::max();
  return static_cast<float>(std::max(static_cast<double>(value) / limit, -1.0));
}

}  // namespace

GltfFile::GltfFile(const std::filesystem::path& file) : folder_(file.parent_path()) {
  const std::vector<uint8_t> bytes = bytes_in(file);
  files_.insert(file.lexically_normal());
  std::span<const uint8_t> text = bytes, binary;
  const bool is_binary = bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0;
  if (is_binary) {
    const Chunks chunks = chunks_of(bytes);
    text = chunks.json;
    binary = chunks.binary;
  }
  json_ = Json::parse(text.begin(), text.end());
  if (!json_.is_object()) fail_gltf("its JSON is no object");
  const Json asset = json_.value("asset", Json::object());
  const auto version = asset.is_object() ? asset.find("version") : asset.end();
  const bool is_new = version != asset.end() && version->is_string() && version->get<std::string>().starts_with("2.");
  if (!is_new) throw OldGltf(length("nodes"));
  buffers_.emplace_back(binary.begin(), binary.end());  // the first buffer, if it has no URI
  read_buffers();
}

void GltfFile::read_buffers() {
  std::vector<uint8_t> binary = std::move(buffers_.front());
  const size_t count = length("buffers");
  buffers_.assign(count, {});
  faults_.assign(count, {});
  for (size_t i = 0; i < count; ++i) {
    const std::string uri = element("buffers", i).value("uri", "");
    if (uri.empty()) {
      if (i == 0) buffers_[0] = std::move(binary);
    } else if (std::optional<std::vector<uint8_t>> data = data_of(uri)) {
      buffers_[i] = *std::move(data);
    } else {
      const std::filesystem::path file = folder_ / percent_decoded(uri);
      std::error_code error;
      if (!std::filesystem::exists(file, error)) {
        faults_[i] = "its buffer '" + uri + "': there is no such file";
      } else if (!may_be_read(file)) {
        faults_[i] = "its file '" + file.string() + "' is not a regular file of at most 256 MB";
      } else {
        buffers_[i] = bytes_in(file);
        files_.insert(file.lexically_normal());
      }
    }
  }
}

std::optional<std::vector<uint8_t>> GltfFile::data_of(std::string_view uri) {
  if (!uri.starts_with("data:")) return std::nullopt;
  const size_t comma = uri.find(',');
  if (comma == std::string_view::npos || !uri.substr(0, comma).ends_with(";base64")) {
    fail_gltf("a data URI is not in base 64");
  }
  return base64_decoded(uri.substr(comma + 1));
}

size_t GltfFile::count_at(const Json& object, const char* key, std::optional<size_t> otherwise) {
  const auto found = object.find(key);
  if (found == object.end()) {
    if (otherwise) return *otherwise;
    fail_gltf(std::string("its key '") + key + "' is missing");
  }
  const double value = found->is_number() ? found->get<double>() : -1.0;
  if (!(value >= 0.0 && value <= 4e9 && value == std::floor(value))) {
    fail_gltf(std::string("its key '") + key + "' is not an integer from 0 to 4e9");
  }
  return static_cast<size_t>(value);
}

size_t GltfFile::length(const char* list) const {
  const auto found = json_.find(list);
  return found == json_.end() ? 0 : found->size();
}

const GltfFile::Json& GltfFile::element(const char* list, size_t index) const {
  const auto found = json_.find(list);
  if (found == json_.end() || !found->is_array() || index >= found->size()) {
    fail_gltf(std::string("it has no ") + list + "[" + std::to_string(index) + "]");
  }
  return (*found)[index];
}

std::span<const uint8_t> GltfFile::view(size_t index) const {
  const Json& view = element("bufferViews", index);
  const size_t buffer = count_at(view, "buffer"), offset = count_at(view, "byteOffset", 0),
               length = count_at(view, "byteLength");
  if (buffer >= buffers_.size()) fail_gltf("it has no buffers[" + std::to_string(buffer) + "]");
  if (!faults_[buffer].empty()) fail_gltf(faults_[buffer]);
  const std::span<const uint8_t> bytes = buffers_[buffer];
  if (offset > bytes.size() || length > bytes.size() - offset) {
    fail_gltf("bufferViews[" + std::to_string(index) + "] ends after its buffer");
  }
  return bytes.subspan(offset, length);
}

// Reads elements from a view. @param source  the accessor, or a part of a sparse one.
template <class Value>
void GltfFile::read(const Json& source, size_t components, const Json& accessor, std::span<Value> out) const {
  const size_t index = count_at(source, "bufferView"), offset = count_at(source, "byteOffset", 0);
  const std::span<const uint8_t> bytes = view(index);
  [[maybe_unused]] const bool is_normalized = accessor.value("normalized", false);
  with_component(count_at(accessor, "componentType"), [&](auto component) {
    using Component = decltype(component);
    const size_t packed = components * sizeof component;
    const size_t stride = std::max<size_t>(count_at(element("bufferViews", index), "byteStride", packed), 1);
    const size_t count = out.size() / components;
    if (count > 0 && (count - 1) * stride + packed + offset > bytes.size())
      fail_gltf("an accessor ends after its bufferView");
    for (size_t i = 0; i < out.size(); ++i) {
      Component value{};
      std::memcpy(&value, bytes.data() + offset + i / components * stride + i % components * sizeof value,
                  sizeof value);
      if constexpr (std::is_same_v<Value, float>) {
        out[i] = is_normalized ? normalized(value) : static_cast<float>(value);
      } else if constexpr (std::is_floating_point_v<Component>) {
        fail_gltf("indices are not integers");
      } else {
        out[i] = static_cast<Value>(value);
      }
    }
  });
}

template <class Value>
std::vector<Value> GltfFile::values(const Json& accessor, size_t components) const {
  const size_t count = count_at(accessor, "count");
  if (count > kMaxNumbers / components) fail_gltf("an accessor has more than 30 million numbers");
  std::vector<Value> result(count * components);
  if (accessor.contains("bufferView")) read<Value>(accessor, components, accessor, result);
  const auto sparse = accessor.find("sparse");
  if (sparse == accessor.end()) return result;
  const size_t changed = count_at(*sparse, "count");
  if (changed > count) fail_gltf("a sparse accessor changes more elements than it has");
  std::vector<uint32_t> places(changed);
  read<uint32_t>(sparse->at("indices"), 1, sparse->at("indices"), places);
  std::vector<Value> changes(changed * components);
  read<Value>(sparse->at("values"), components, accessor, changes);
  for (size_t i = 0; i < changed; ++i) {
    if (places[i] >= count) fail_gltf("a sparse accessor has an index out of range");
    std::copy_n(changes.data() + i * components, components, result.data() + places[i] * components);
  }
  return result;
}

GltfNumbers GltfFile::numbers(size_t index) const {
  const Json& accessor = element("accessors", index);
  return in_element("accessors", index, [&]() -> GltfNumbers {
    const size_t components = components_of(accessor.at("type").get<std::string>());
    return {values<float>(accessor, components), components};
  });
}

std::vector<uint32_t> GltfFile::indices(size_t index) const {
  const Json& accessor = element("accessors", index);
  return in_element("accessors", index, [&] {
    if (components_of(accessor.at("type").get<std::string>()) != 1) fail_gltf("indices are not of the type SCALAR");
    return values<uint32_t>(accessor, 1);
  });
}

}  // namespace hedgehop::scenes::mesh
