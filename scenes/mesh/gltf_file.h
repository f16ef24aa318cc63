#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace hedgehop::scenes::mesh {

/// Throws std::invalid_argument.
[[noreturn]] inline void fail_gltf(const std::string& why) { throw std::invalid_argument(why); }

/// The values of an accessor, element after element.
struct GltfNumbers {
  std::vector<float> values;
  size_t components = 1;  ///< per element
  size_t count() const { return values.size() / components; }
};

/// The JSON and the buffers of a glTF file. All functions throw std::invalid_argument or nlohmann's exceptions for a
/// bad file.
class GltfFile {
 public:
  using Json = nlohmann::json;

  explicit GltfFile(const std::filesystem::path& file);

  const Json& json() const { return json_; }
  const std::set<std::filesystem::path>& files() const { return files_; }
  const std::filesystem::path& folder() const { return folder_; }

  /// Returns the length of a list at the top of the JSON; 0 if there is none.
  size_t length(const char* list) const;
  /// Returns an element of a list at the top of the JSON.
  const Json& element(const char* list, size_t index) const;

  /// Returns the values of an accessor. Normalized integers become 0..1 or -1..1.
  GltfNumbers numbers(size_t accessor) const;
  /// Returns the values of an accessor of integers.
  std::vector<uint32_t> indices(size_t accessor) const;
  /// Returns the bytes of a buffer view.
  std::span<const uint8_t> view(size_t index) const;

  /// Returns the result of `read`. A value of a wrong type, and a missing one, is a fault of this element.
  template <class Read>
  static auto in_element(const char* list, size_t index, const Read& read) {
    try {
      return read();
    } catch (const Json::exception&) {
      fail_gltf(std::string("its ") + list + "[" + std::to_string(index) +
                "] lacks a value or has one of a wrong type");
    }
  }

  /// Returns the bytes of a data URI; empty if the URI is not one.
  static std::optional<std::vector<uint8_t>> data_of(std::string_view uri);

  /// Returns an integer of an object. Throws if it is missing and there is no default.
  static size_t count_at(const Json& object, const char* key, std::optional<size_t> otherwise = {});

 private:
  void read_buffers();
  template <class Value>
  void read(const Json& source, size_t components, const Json& accessor, std::span<Value> out) const;
  template <class Value>
  std::vector<Value> values(const Json& accessor, size_t components) const;

  std::filesystem::path folder_;
  Json json_;
  std::vector<std::vector<uint8_t>> buffers_;
  std::vector<std::string> faults_;  ///< of buffers that cannot be read; an error if they are used
  std::set<std::filesystem::path> files_;
};

}  // namespace hedgehop::scenes::mesh
