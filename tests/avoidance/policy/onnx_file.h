#pragma once

#include <bit>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

/// Writes small networks as ONNX without another library. Message and field numbers:
/// onnx.proto3 of the ONNX standard, IR version 7.
namespace hedgehop::onnx_file {

using Message = std::string;

inline Message varint(uint64_t value) {
  Message bytes;
  for (; value >= 0x80; value >>= 7) bytes += static_cast<char>(value | 0x80);
  return bytes += static_cast<char>(value);
}
inline Message number(int field, uint64_t value) { return varint(static_cast<uint64_t>(field) << 3) + varint(value); }
inline Message bytes(int field, const Message& content) {
  return varint(static_cast<uint64_t>(field) << 3 | 2) + varint(content.size()) + content;
}

inline Message tensor(const std::string& name, const std::vector<uint64_t>& sizes, const std::vector<float>& values) {
  Message raw;
  for (const float value : values) {
    const auto word = std::bit_cast<uint32_t>(value);
    for (int i = 0; i < 4; ++i) raw += static_cast<char>(word >> (8 * i));
  }
  Message content;
  for (const uint64_t size : sizes) content += number(1, size);
  return content + number(2, 1) + bytes(8, name) + bytes(9, raw);
}
inline Message value_info(const std::string& name, const std::vector<uint64_t>& sizes) {
  Message shape;
  for (const uint64_t size : sizes) shape += bytes(1, number(1, size));
  return bytes(1, name) + bytes(2, bytes(1, number(1, 1) + bytes(2, shape)));
}
inline Message attribute(const std::string& name, uint64_t value) {
  return bytes(1, name) + number(3, value) + number(20, 2);
}
inline Message node(const std::string& type, const std::vector<std::string>& inputs, const std::string& output,
                    const std::vector<Message>& attributes = {}) {
  Message content;
  for (const std::string& input : inputs) content += bytes(1, input);
  content += bytes(2, output) + bytes(3, output) + bytes(4, type);
  for (const Message& each : attributes) content += bytes(5, each);
  return content;
}

inline void write(const std::filesystem::path& file, const Message& graph) {
  std::ofstream(file, std::ios::binary) << number(1, 7) + bytes(7, graph) + bytes(8, bytes(1, "") + number(2, 13));
}

/// action = weights (mean of the image `input`, state) + offset, weights 4 x 11 by rows.
inline void write_linear_policy(const std::filesystem::path& file, uint64_t rows, uint64_t columns,
                                const std::vector<float>& weights, const std::vector<float>& offset,
                                const std::string& output = "action", const std::string& input = "front_grey") {
  write(file, bytes(1, node("GlobalAveragePool", {input}, "pooled")) +
                  bytes(1, node("Flatten", {"pooled"}, "mean", {attribute("axis", 1)})) +
                  bytes(1, node("Concat", {"mean", "state"}, "all", {attribute("axis", 1)})) +
                  bytes(1, node("Gemm", {"all", "weights", "offset"}, output, {attribute("transB", 1)})) +
                  bytes(2, "linear") + bytes(5, tensor("weights", {offset.size(), 11}, weights)) +
                  bytes(5, tensor("offset", {offset.size()}, offset)) +
                  bytes(11, value_info(input, {1, 1, rows, columns})) + bytes(11, value_info("state", {1, 10})) +
                  bytes(12, value_info(output, {1, offset.size()})));
}

}  // namespace hedgehop::onnx_file
