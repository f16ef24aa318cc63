#include "sim/config/names.h"

#include <fmt/format.h>

#include <algorithm>

namespace hedgehop::sim {

std::string name_fault(std::string_view name) {
  constexpr size_t kMaxBytes = 200;
  if (name.empty()) return "must not be empty";
  if (name.size() > kMaxBytes) return fmt::format("has {} bytes; at most {} are allowed", name.size(), kMaxBytes);
  for (const char c : {'/', '\\'}) {
    if (name.find(c) != std::string_view::npos) return fmt::format("must not contain '{}'", c);
  }
  const bool control =
      std::ranges::any_of(name, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; });
  if (control) return "must not contain line breaks or other control characters";
  if (name[0] == '.' || name[0] == '-') return fmt::format("must not begin with '{}'", name[0]);
  return "";
}

}  // namespace hedgehop::sim
