#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/config/input_error.h"

namespace hedgehop::sim {

/// A key of an earlier version and its name in this version.
struct RenamedKey {
  std::string before, now;
};

/// Reads the members of one JSON object. Every member has one type, and only numbers that may be unknown may be null.
/// The functions throw InputError with the path of a key of another type.
class JsonReader {
 public:
  JsonReader(const nlohmann::ordered_json& object, std::string path) : object_(object), path_(std::move(path)) {
    if (!object.is_object()) refuse("");
  }

  void refuse_renamed(std::span<const RenamedKey> keys) const {
    for (const RenamedKey& key : keys) {
      if (!object_.contains(key.before)) continue;
      throw InputError(
          fmt::format("key '{}' of an earlier version is now '{}'; fly again", named(key.before), named(key.now)));
    }
  }

  void require(std::initializer_list<const char*> keys) const {
    for (const char* key : keys) {
      if (!object_.contains(key)) refuse(key);
    }
  }
  bool has(const char* key) const { return object_.contains(key); }
  std::string text(const char* key) const {
    const nlohmann::ordered_json* const value = find(key);
    if (!value) return "";
    if (!value->is_string()) refuse(key);
    return value->get<std::string>();
  }
  bool flag(const char* key) const {
    const nlohmann::ordered_json* const value = find(key);
    if (value && !value->is_boolean()) refuse(key);
    return value && value->get<bool>();
  }
  std::optional<double> optional_number(const char* key) const {
    const nlohmann::ordered_json* const value = find(key);
    if (!value || value->is_null()) return {};
    if (!value->is_number()) refuse(key);
    return value->get<double>();
  }
  double number(const char* key, double unknown = NAN) const { return optional_number(key).value_or(unknown); }
  double finite_number(const char* key) const {
    const std::optional<double> value = optional_number(key);
    if (!value) refuse(key);
    return *value;
  }
  int64_t count(const char* key) const {
    const nlohmann::ordered_json* const value = find(key);
    if (value && !value->is_number()) refuse(key);
    return value ? value->get<int64_t>() : 0;
  }
  uint64_t unsigned_number(const char* key) const {
    const nlohmann::ordered_json* const value = find(key);
    if (!value || !value->is_number_unsigned()) refuse(key);
    return value->get<uint64_t>();
  }
  std::vector<std::string> texts(const char* key) const {
    std::vector<std::string> all;
    for (const nlohmann::ordered_json& one : array(key)) {
      if (!one.is_string()) refuse(key);
      all.push_back(one.get<std::string>());
    }
    return all;
  }
  const nlohmann::ordered_json& array(const char* key) const {
    static const nlohmann::ordered_json kNone = nlohmann::ordered_json::array();
    const nlohmann::ordered_json* const value = find(key);
    if (value && !value->is_array()) refuse(key);
    return value ? *value : kNone;
  }
  /// The object of a key; an empty one if it is missing.
  JsonReader object(const char* key) const {
    static const nlohmann::ordered_json kNone = nlohmann::ordered_json::object();
    const nlohmann::ordered_json* const value = find(key);
    return {value ? *value : kNone, named(key)};
  }
  const nlohmann::ordered_json& json() const { return object_; }
  [[noreturn]] void refuse(std::string_view key) const {
    throw InputError(fmt::format("'{}' is missing or of another type", named(key)));
  }

 private:
  const nlohmann::ordered_json* find(const char* key) const {
    const auto found = object_.find(key);
    return found == object_.end() ? nullptr : &*found;
  }
  std::string named(std::string_view key) const {
    return path_.empty() || key.empty() ? path_ + std::string(key) : fmt::format("{}.{}", path_, key);
  }

  const nlohmann::ordered_json& object_;
  std::string path_;
};

// Numbers for JSON, which has no notation for values that are not finite: null replaces them.

nlohmann::ordered_json json_number(double value);

/// Rounded to five significant figures.
nlohmann::ordered_json brief(double value);

/// Rounded to three decimals.
nlohmann::ordered_json milli(double value);

}  // namespace hedgehop::sim
