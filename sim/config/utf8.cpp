#include "sim/config/utf8.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;

/// Bits of the first byte, and the smallest character that needs this number of bytes.
struct Utf8Form {
  unsigned mask, lead;
  uint32_t smallest;
};
constexpr Utf8Form kForms[] = {{0x80, 0x00, 0}, {0xe0, 0xc0, 0x80}, {0xf0, 0xe0, 0x800}, {0xf8, 0xf0, 0x10000}};

std::string escaped(char byte) { return fmt::format("\\x{:02X}", static_cast<unsigned char>(byte)); }

Json with_utf8_texts(const Json& json) {
  if (json.is_string()) return utf8_text(json.get_ref<const std::string&>());
  Json copy = json;
  if (json.is_array()) {
    for (Json& one : copy) one = with_utf8_texts(one);
  } else if (json.is_object()) {
    copy = Json::object();
    for (const auto& [key, value] : json.items()) copy[utf8_text(key)] = with_utf8_texts(value);
  }
  return copy;
}

}  // namespace

std::pair<size_t, uint32_t> first_character(std::string_view text) {
  if (text.empty()) return {0, 0};
  const auto byte = [&](size_t i) { return static_cast<unsigned char>(text[i]); };
  for (size_t length = 1; length <= std::min<size_t>(4, text.size()); ++length) {
    const Utf8Form& form = kForms[length - 1];
    if ((byte(0) & form.mask) != form.lead) continue;
    uint32_t character = byte(0) & ~form.mask;
    for (size_t i = 1; i < length; ++i) {
      if ((byte(i) & 0xc0u) != 0x80u) return {0, 0};
      character = character << 6 | (byte(i) & 0x3fu);
    }
    const bool valid = character >= form.smallest && character <= 0x10ffff;
    return valid && (character < 0xd800 || character > 0xdfff) ? std::pair{length, character}
                                                               : std::pair{size_t{0}, 0u};
  }
  return {0, 0};
}

std::string utf8_text(std::string_view bytes) {
  std::string text;
  while (!bytes.empty()) {
    const size_t length = first_character(bytes).first;
    text += length > 0 ? std::string(bytes.substr(0, length)) : escaped(bytes[0]);
    bytes.remove_prefix(std::max<size_t>(1, length));
  }
  return text;
}

std::string name_text(std::string_view name) {
  std::string text;
  for (size_t i = 0; i < name.size(); ++i) {
    const bool ambiguous = name[i] == '\\' && i + 1 < name.size() && name[i + 1] == 'x';
    text += ambiguous ? escaped('\\') : std::string(1, name[i]);
  }
  return utf8_text(text);
}

std::string raw_name(std::string_view text) {
  std::string name;
  for (size_t i = 0; i < text.size(); ++i) {
    unsigned byte = 0;
    const bool begins = text.substr(i).starts_with("\\x") && i + 4 <= text.size();
    const char* const digits = begins ? text.data() + i + 2 : nullptr;
    if (begins && std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2) {
      name += static_cast<char>(byte);
      i += 3;
    } else {
      name += text[i];
    }
  }
  return name;
}

std::string json_text(const Json& json, int indent) {
  try {
    return json.dump(indent);
  } catch (const Json::type_error&) {  // a string that is not UTF-8
    return with_utf8_texts(json).dump(indent);
  }
}

}  // namespace hedgehop::sim
