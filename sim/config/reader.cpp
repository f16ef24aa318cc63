#include "sim/config/reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "sim/fields/bounds.h"

namespace hedgehop::sim {
namespace {

/// "a number", "a number in m".
std::string number_words(std::string_view noun, const fields::Field& field) {
  return field.unit.empty() ? std::string(noun) : fmt::format("{} in {}", noun, field.unit);
}

template <class T>
bool within_bounds(T member, const Node& node, const std::string& path, const fields::Field& field, Faults& faults) {
  const std::optional<std::string> bound = fields::broken_bound(static_cast<double>(member), field);
  if (bound) faults.add(node.place, fmt::format("'{}' must be {}, got {}", path, *bound, node.text));
  return !bound;
}

struct Renamed {
  std::string_view path, key, now;  // in the map at `path`
};

// Since 0.1, and drawing.context since 0.2.
constexpr std::array<Renamed, 8> kRenamed = {{{"drawing", "gl", "renderer"},
                                              {"drawing", "context", "renderer"},
                                              {"avoidance", "front_end", "source"},
                                              {"avoidance", "sight", "depth"},
                                              {"avoidance", "rows", "sections"},
                                              {"avoidance", "cols", "sections"},
                                              {"avoidance", "passed", "passed_radius"},
                                              {"avoidance.map", "young_misses", "unconfirmed_misses"}}};

struct Removed {
  std::string_view path, key, neighbor, advice;  // `neighbor`: a key that is still in the map at `path`
};

constexpr std::array<Removed, 1> kRemoved = {
    {{"", "chance", "physics_rate",
      "it was removed with `hedgehop estimate`; to bound a rate, use `hedgehop batch --until`"}}};

struct RenamedChoice {
  std::string_view path, choice, now;
};

// Since 0.2.
constexpr std::array<RenamedChoice, 2> kRenamedChoices = {
    {{"avoidance.law", "printed", "published"}, {"avoidance.law", "ours", "modified"}}};

/// Returns the end of the message that refuses a choice: its new name, or the valid choices.
std::string instead_of_choice(const std::string& path, std::string_view choice,
                              const std::vector<std::string_view>& allowed) {
  const auto found = std::ranges::find_if(kRenamedChoices, [&](const RenamedChoice& renamed) {
    return renamed.path == path && renamed.choice == choice && std::ranges::find(allowed, renamed.now) != allowed.end();
  });
  return found == kRenamedChoices.end() ? suggestion(choice, allowed)
                                        : fmt::format("; its name is now '{}'", found->now);
}

/// What to write instead of a key that is not among those allowed.
std::string instead(const std::string& path, std::string_view key, const std::vector<std::string_view>& allowed) {
  const auto found = std::ranges::find_if(kRenamed, [&](const Renamed& renamed) {
    return renamed.path == path && renamed.key == key && std::ranges::find(allowed, renamed.now) != allowed.end();
  });
  if (found != kRenamed.end()) return fmt::format("; its name is now '{}'", found->now);
  const auto removed = std::ranges::find_if(kRemoved, [&](const Removed& row) {
    return row.path == path && row.key == key && std::ranges::find(allowed, row.neighbor) != allowed.end();
  });
  return removed == kRemoved.end() ? suggestion(key, allowed) : fmt::format("; {}", removed->advice);
}

void expected(std::string_view what, const Node& node, const std::string& path, Faults& faults) {
  faults.add(node.place, fmt::format("{} expects {}, got {}", path_words(path), what, node.words()));
}

bool is_plain_scalar(const Node& node) { return node.kind == Node::Kind::scalar && !node.quoted; }

/// A whole number that its type cannot hold, or no whole number at all.
template <class T>
void refuse_integer(T lowest, T highest, const Node& node, const std::string& path, const fields::Field& field,
                    Faults& faults) {
  const size_t sign = node.text.starts_with('-') || node.text.starts_with('+') ? 1 : 0;
  const bool digits_only =
      node.text.size() > sign && node.text.find_first_not_of("0123456789", sign) == std::string::npos;
  if (is_plain_scalar(node) && digits_only) {
    faults.add(node.place, fmt::format("'{}' must lie between {} and {}, got {}", path, lowest, highest, node.text));
  } else {
    expected(number_words("a whole number", field), node, path, faults);
  }
}

}  // namespace

std::optional<double> read_number(const Node& node, const std::string& path, const fields::Field& field,
                                  Faults& faults) {
  using Kind = ParsedNumber::Kind;
  const ParsedNumber parsed =
      is_plain_scalar(node) ? parse_number(node.text, fields::is_degrees(field.unit)) : ParsedNumber{};
  if (parsed.kind == Kind::not_finite) {
    faults.add(node.place, fmt::format("'{}' must be finite, got {}", path, node.text));
  } else if (parsed.kind == Kind::not_a_number) {
    expected(number_words("a number", field), node, path, faults);
  } else if (within_bounds(parsed.member, node, path, field, faults)) {
    return parsed.member;
  }
  return {};
}

std::optional<int64_t> read_signed(const Node& node, const std::string& path, const fields::Field& field,
                                   int64_t lowest, int64_t highest, Faults& faults) {
  const std::optional<int64_t> value = is_plain_scalar(node) ? parse_signed(node.text) : std::nullopt;
  if (!value || *value < lowest || *value > highest) {
    refuse_integer(lowest, highest, node, path, field, faults);
    return {};
  }
  return within_bounds(*value, node, path, field, faults) ? value : std::nullopt;
}

std::optional<uint64_t> read_unsigned(const Node& node, const std::string& path, const fields::Field& field,
                                      uint64_t highest, Faults& faults) {
  const std::optional<uint64_t> value = is_plain_scalar(node) ? parse_unsigned(node.text) : std::nullopt;
  if (!value || *value > highest) {
    refuse_integer(uint64_t{0}, highest, node, path, field, faults);
    return {};
  }
  return within_bounds(*value, node, path, field, faults) ? value : std::nullopt;
}

std::optional<bool> read_bool(const Node& node, const std::string& path, Faults& faults) {
  if (is_plain_scalar(node)) {
    if (node.text == "true") return true;
    if (node.text == "false") return false;
  }
  expected("true or false", node, path, faults);
  return {};
}

std::optional<std::string> read_text(const Node& node, const std::string& path, Faults& faults) {
  if (node.kind == Node::Kind::scalar) return node.text;
  expected("a text", node, path, faults);
  return {};
}

std::optional<std::filesystem::path> read_path(const Node& node, const std::string& path, Faults& faults) {
  if (node.kind != Node::Kind::scalar) {
    expected("the path of a file", node, path, faults);
    return {};
  }
  if (node.text.empty()) return std::filesystem::path();
  const bool in_file = node.place.line > 0;
  const auto folder = in_file ? std::filesystem::path(node.place.file).parent_path() : std::filesystem::path();
  return std::filesystem::absolute(folder / node.text).lexically_normal();
}

std::optional<size_t> read_choice(const Node& node, const std::string& path,
                                  const std::vector<std::string_view>& choices, Faults& faults) {
  if (node.kind != Node::Kind::scalar) {
    expected("one of: " + fmt::format("{}", fmt::join(choices, ", ")), node, path, faults);
    return {};
  }
  const auto found = std::find(choices.begin(), choices.end(), node.text);
  if (found != choices.end()) return static_cast<size_t>(found - choices.begin());
  faults.add(node.place, fmt::format("unknown choice '{}' for '{}'{}", node.text, path,
                                     instead_of_choice(path, node.text, choices)));
  return {};
}

void refuse_key_as_choice(const Node& name, std::string_view selector, Faults& faults) {
  faults.add(name.place, fmt::format("'{0}' is no choice of '{1}' but a key beside it: '{0}: FILE'; hedgehop list {1}s "
                                     "has its keys",
                                     name.text, selector));
}

bool expect_list(const Node& node, const std::string& path, size_t size, Faults& faults) {
  if (node.kind != Node::Kind::list) {
    expected(size == 0 ? std::string("a list") : fmt::format("a list of {} numbers", size), node, path, faults);
    return false;
  }
  if (size != 0 && node.items.size() != size) {
    faults.add(node.place, fmt::format("'{}' expects a list of {} numbers, got {}", path, size, node.items.size()));
    return false;
  }
  return true;
}

bool expect_map(const Node& node, const std::string& path, Faults& faults) {
  if (node.kind == Node::Kind::map) return true;
  expected("a map of keys", node, path, faults);
  return false;
}

void StructReader::missing(std::string_view key, const fields::Field& field) const {
  if (map_.incomplete) return;  // the file that is not there may have it
  const std::string unit = field.unit.empty() ? "" : fmt::format(" ({})", field.unit);
  const std::string meaning = field.meaning.empty() ? "" : fmt::format(": {}{}", field.meaning, unit);
  faults_.add(map_.place, fmt::format("missing key '{}' in {}{}", key, path_words(path_), meaning));
}

void StructReader::finish() const {
  for (const Entry& entry : map_.entries) {
    if (std::find(keys_.begin(), keys_.end(), entry.key) != keys_.end()) continue;
    faults_.add(entry.place, fmt::format("unknown key '{}' in {}{}", entry.key, path_words(path_),
                                         instead(path_, entry.key, keys_)));
  }
}

}  // namespace hedgehop::sim
