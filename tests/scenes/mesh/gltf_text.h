#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace hedgehop::scenes::mesh {

inline std::string base64(const std::vector<uint8_t>& bytes) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t three = 0;
    for (size_t k = 0; k < 3; ++k) three = three << 8 | (i + k < bytes.size() ? bytes[i + k] : 0u);
    for (size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? digits[three >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

inline const std::string kOneNode = R"("scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}])";

/// Returns the mesh of one primitive. @param rest  more keys of the primitive.
inline std::string mesh_of(const std::string& attributes, const std::string& indices, const std::string& rest = "") {
  return R"("meshes": [{"primitives": [{"attributes": {)" + attributes + R"(}, "indices": )" + indices +
         R"(, "material": 0)" + rest + "}]}]";
}

constexpr int kByte = 5120, kUByte = 5121, kShort = 5122, kUShort = 5123, kFloat = 5126;  ///< component types

/// Writes glTF files. Accessors are added in order; the rest is JSON.
struct GltfText {
  std::vector<uint8_t> bytes;
  std::string views, accessors;
  size_t count = 0;

  /// Adds an accessor and returns its index as text. @param rest  more keys, such as ", \"normalized\": true".
  template <class Value>
  std::string add(const std::vector<Value>& values, int component_type, size_t components,
                  const std::string& rest = "") {
    while (bytes.size() % 4 != 0) bytes.push_back(0);
    const size_t size = values.size() * sizeof(Value), at = bytes.size();
    bytes.resize(at + size);
    std::memcpy(bytes.data() + at, values.data(), size);
    const std::array<const char*, 5> types{"", "SCALAR", "VEC2", "VEC3", "VEC4"};
    const std::string comma = count == 0 ? "" : ", ";
    views += comma + R"({"buffer": 0, "byteOffset": )" + std::to_string(at) + R"(, "byteLength": )" +
             std::to_string(size) + "}";
    accessors += comma + R"({"bufferView": )" + std::to_string(count) + R"(, "componentType": )" +
                 std::to_string(component_type) + R"(, "count": )" + std::to_string(values.size() / components) +
                 R"(, "type": ")" + types[components] + "\"" + rest + "}";
    return std::to_string(count++);
  }

  /// @param rest  the other keys of the file.
  std::string text(const std::string& rest) const {
    return R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": )" + std::to_string(bytes.size()) +
           R"(, "uri": "data:application/octet-stream;base64,)" + base64(bytes) + R"("}], "bufferViews": [)" + views +
           R"(], "accessors": [)" + accessors + "], " + rest + "}";
  }
};

/// A quad in the plane z = 0, 2 wide and 2 high around the origin, that faces +z; its image is upright.
struct QuadData {
  std::vector<float> corners{-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0};
  std::vector<float> uvs{0, 1, 1, 1, 1, 0, 0, 0};
  std::vector<uint16_t> indices{0, 1, 2, 0, 2, 3};
};

/// A cube from -1 to 1 with faces outward.
struct CubeData {
  std::vector<float> corners;
  std::vector<uint16_t> indices;

  CubeData() {
    for (int k = 0; k < 8; ++k) {
      for (const int axis : {0, 1, 2}) corners.push_back((k >> axis & 1) != 0 ? 1.0f : -1.0f);
    }
    indices = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
               2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  }
};

}  // namespace hedgehop::scenes::mesh
