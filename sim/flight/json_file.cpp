#include "sim/flight/json_file.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "sim/config/input_error.h"
#include "sim/config/whole_file.h"

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kMaxDepth = 50;  // readers and writers of JSON are recursive

/// Returns the part of a text between two others; empty if it has none.
std::string_view between(std::string_view text, std::string_view before, std::string_view after) {
  const size_t start = text.find(before);
  if (start == std::string_view::npos) return {};
  text.remove_prefix(start + before.size());
  return text.substr(0, text.find(after));
}

}  // namespace

std::string json_fault(const std::filesystem::path& file, const std::exception& error, std::string_view kind) {
  const std::string_view text = error.what();
  if (dynamic_cast<const nlohmann::json::parse_error*>(&error) != nullptr) {
    const std::string_view line = between(text, " at line ", ","), column = between(text, ", column ", ":");
    const std::string place = line.empty() || column.empty() ? "" : fmt::format(":{}:{}", line, column);
    const bool ends_early = text.find("unexpected end of input") != std::string_view::npos;
    return fmt::format("{}{}: is not {} JSON", file.string(), place, ends_early ? "complete" : "valid");
  }
  const auto is_not = [&](std::string_view why) { return fmt::format("{}: is not {}: {}", file.string(), kind, why); };
  if (const std::string_view key = between(text, "key '", "' not found"); !key.empty()) {
    return is_not(fmt::format("the key '{}' is missing", key));
  }
  if (dynamic_cast<const nlohmann::json::type_error*>(&error) != nullptr) return is_not("a value is of another type");
  const size_t code_end = text.find("] ");  // of "[json.exception.out_of_range.406] "
  return is_not(code_end == std::string_view::npos ? text : text.substr(code_end + 2));
}

Json read_json(const std::filesystem::path& file) {
  const auto bounded = [&](int depth, Json::parse_event_t, const Json&) {
    if (depth > kMaxDepth) throw InputError(fmt::format("{}: is nested deeper than {}", file.string(), kMaxDepth));
    return true;
  };
  const std::string text = read_file_whole(file);
  try {
    return Json::parse(text, bounded);
  } catch (const nlohmann::json::exception& fault) {
    throw InputError(json_fault(file, fault, "valid JSON"));
  }
}

}  // namespace hedgehop::sim
