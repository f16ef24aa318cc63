#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace hedgehop::fields {

/// Error of a config in one of its fields; its text is "key: message".
class InvalidField : public std::invalid_argument {
 public:
  /// @param key  dotted, from the config.
  InvalidField(std::string key, std::string message)
      : std::invalid_argument(key + ": " + message), key_(std::move(key)), message_(std::move(message)) {}

  const std::string& key() const { return key_; }
  const std::string& message() const { return message_; }

 private:
  std::string key_, message_;
};

/// Throws InvalidField unless a condition on the field holds.
inline void require(bool holds, std::string_view key, const std::string& message) {
  if (!holds) throw InvalidField(std::string(key), message);
}

}  // namespace hedgehop::fields
